//! Role of a contact with the wall of a bore (docs/theory.md, 2.8).

use super::element_pair::ElementPair;
use crate::state::{ContactRole, RecordsOfKey};
use pong_geometry::Vec3;
use pong_geometry::interference::Interference;
use pong_geometry::interference::ball_bore::is_behind_wall;

/// Role of the contact between the wall of a bore and a point of A, given in A's frame (`local`). A point
/// that was behind the wall at the last commit, and was not pushed there, came through the wall from behind.
/// Its contact is `WrongSide` until the overlap with the wall ends.
pub(crate) fn role_in_bore(
    pair: &ElementPair<'_>,
    remembered: &RecordsOfKey<'_>,
    local: &Vec3,
    contact: &Interference,
) -> ContactRole {
    let came_from_behind = || {
        let earlier = pair.motion().since_commit.map(|since| since.x_ba.point(local));
        let bore = &pair.body_b().bores[pair.item_b.element as usize];
        earlier.is_some_and(|earlier| is_behind_wall(&earlier, bore))
    };
    match remembered.role_of_nearest(&contact.normal_b, contact.feature) {
        Some(ContactRole::WrongSide) => ContactRole::WrongSide,
        Some(ContactRole::Active | ContactRole::Tracked) => ContactRole::Active,
        None if came_from_behind() => ContactRole::WrongSide,
        None => ContactRole::Active,
    }
}
