//! Model files with a pose as arguments: `part.ron@0,1.5,0`.

use pong_geometry::{Pose, Quat, Vec3};
use pong_model::PlacedFile;

/// Name of the argument in usage and help.
pub(crate) const VALUE_NAME: &str = "MODEL.ron[@X,Y,Z[,QW,QX,QY,QZ]]";

/// Model file and pose from an argument; the pose is the identity unless given.
pub(crate) fn placed(text: &str) -> Result<PlacedFile, String> {
    let (path, place) = match text.rsplit_once('@') {
        Some((path, place)) if place.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) => {
            (path, place)
        }
        _ => return Ok(PlacedFile { path: text.into(), pose: Pose::identity() }),
    };
    let numbers: Option<Vec<f64>> = place.split(',').map(|number| number.trim().parse().ok()).collect();
    let wanted = "write x,y,z in m, or x,y,z and a quaternion w,x,y,z of length 1";
    let numbers = numbers.filter(|numbers| numbers.iter().all(|x: &f64| x.is_finite())).ok_or(wanted)?;
    let (position, orientation) = match numbers[..] {
        [x, y, z] => (Vec3::new(x, y, z), Quat::identity()),
        [x, y, z, qw, qx, qy, qz] => {
            let norm = [qw, qx, qy, qz].map(|q| q * q).iter().sum::<f64>().sqrt();
            if (norm - 1.0).abs() > 1e-3 {
                return Err(format!("the length of the quaternion is {norm}, not 1"));
            }
            (Vec3::new(x, y, z), Pose::new(Vec3::zeros(), [qw, qx, qy, qz]).orientation)
        }
        _ => return Err(wanted.to_owned()),
    };
    Ok(PlacedFile { path: path.into(), pose: Pose { position, orientation } })
}
