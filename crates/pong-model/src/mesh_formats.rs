//! OBJ and STL as the crates read them. Public for `pong-import`, which reads by the same rules; no stable interface.

use std::io::{Cursor, Error, ErrorKind};
use std::path::Path;

/// Bytes of a binary STL file before its first triangle.
const STL_HEAD: usize = 84;
/// Bytes of a triangle in a binary STL file.
pub const STL_TRIANGLE: usize = 50;

/// Faces of any number of corners; materials, points and lines are left aside.
///
/// # Errors
/// What the crate says of a damaged file.
pub fn obj(bytes: &[u8]) -> Result<Vec<tobj::Model>, String> {
    let options =
        tobj::LoadOptions { ignore_points: true, ignore_lines: true, ..tobj::LoadOptions::default() };
    let no_materials = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
    let read = tobj::load_obj_buf(&mut Cursor::new(bytes), &options, no_materials);
    read.map(|(models, _)| models).map_err(|reason| reason.to_string())
}

/// Hands over the corners of each triangle of a binary or a text file.
///
/// # Errors
/// What is damaged, in words.
pub fn stl(mut bytes: Vec<u8>, mut each: impl FnMut([[f32; 3]; 3])) -> Result<(), String> {
    blank_misleading_head(&mut bytes);
    let told = |reason: Error| match reason.kind() {
        ErrorKind::UnexpectedEof => "it ends before its last triangle".to_owned(),
        _ => reason.to_string(),
    };
    for triangle in stl_io::create_stl_reader(&mut Cursor::new(bytes)).map_err(told)? {
        each(triangle.map_err(told)?.vertices.map(|vertex| vertex.0));
    }
    Ok(())
}

/// Some programs begin binary files with "solid", the mark of text files; the length tells them apart.
fn blank_misleading_head(bytes: &mut [u8]) {
    let Some(count) = bytes.get(80..84).and_then(|count| count.try_into().ok()) else { return };
    let count = u32::from_le_bytes(count) as usize;
    if count.checked_mul(STL_TRIANGLE).and_then(|size| size.checked_add(STL_HEAD)) == Some(bytes.len()) {
        bytes[..5].fill(0);
    }
}
