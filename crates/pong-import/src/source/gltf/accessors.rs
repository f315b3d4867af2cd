//! Positions and indices of a primitive, checked before they are read.

use crate::findings::Finding;
use ::gltf::accessor::{DataType, Dimensions};
use ::gltf::mesh::Primitive;

fn damaged(path: &str, cause: String) -> Finding {
    let cure = "export it again".to_owned();
    Finding { path: path.to_owned(), rule: "damaged", cause, cure }
}

fn bytes_of<'b>(buffers: &'b [Vec<u8>]) -> impl Clone + Fn(::gltf::Buffer<'_>) -> Option<&'b [u8]> {
    |buffer: ::gltf::Buffer<'_>| buffers.get(buffer.index()).map(Vec::as_slice)
}

/// Whether what an accessor promises could be in the buffers: without a view all its elements are zero but for the sparse
/// ones, and a short file could ask for any amount of memory.
fn check_count(
    accessor: &::gltf::Accessor<'_>,
    buffers: &[Vec<u8>],
    what: &str,
    path: &str,
) -> Result<(), Finding> {
    let bytes: usize = buffers.iter().map(Vec::len).sum();
    if accessor.view().is_none() && accessor.count() > bytes {
        let cause = format!("it has {} {what}, but no more than {bytes} bytes of buffers", accessor.count());
        return Err(damaged(path, cause));
    }
    Ok(())
}

pub(super) fn positions(
    primitive: &Primitive<'_>,
    buffers: &[Vec<u8>],
    path: &str,
) -> Result<Vec<[f32; 3]>, Finding> {
    let Some(accessor) = primitive.get(&::gltf::Semantic::Positions) else {
        let cause = format!("primitive {} of its mesh has no positions", primitive.index());
        return Err(damaged(path, cause));
    };
    if (accessor.data_type(), accessor.dimensions()) != (DataType::F32, Dimensions::Vec3) {
        let cause = "its positions are not three 32-bit floats each".to_owned();
        let cure = "export without quantization".to_owned();
        return Err(Finding { path: path.to_owned(), rule: "unsupported-extension", cause, cure });
    }
    if accessor.count() == 0 {
        return Ok(Vec::new());
    }
    check_count(&accessor, buffers, "positions", path)?;
    let reader = primitive.reader(bytes_of(buffers));
    let places: Vec<[f32; 3]> = reader.read_positions().map(Iterator::collect).unwrap_or_default();
    match places.len() == accessor.count() {
        true => Ok(places),
        false => Err(damaged(path, "its positions lie outside their buffer".to_owned())),
    }
}

/// The corners in order; every position once if there are no indices.
pub(super) fn indices(
    primitive: &Primitive<'_>,
    buffers: &[Vec<u8>],
    vertices: usize,
    path: &str,
) -> Result<Vec<u32>, Finding> {
    let Some(accessor) = primitive.indices() else { return Ok((0..vertices as u32).collect()) };
    let kind = (accessor.data_type(), accessor.dimensions());
    if !matches!(kind, (DataType::U8 | DataType::U16 | DataType::U32, Dimensions::Scalar)) {
        return Err(damaged(path, "its indices are no unsigned integers".to_owned()));
    }
    if accessor.count() == 0 {
        return Ok(Vec::new());
    }
    check_count(&accessor, buffers, "indices", path)?;
    let reader = primitive.reader(bytes_of(buffers));
    let order: Vec<u32> = reader.read_indices().map(|all| all.into_u32().collect()).unwrap_or_default();
    if order.len() != accessor.count() {
        return Err(damaged(path, "its indices lie outside their buffer".to_owned()));
    }
    match order.iter().find(|index| **index as usize >= vertices) {
        Some(index) => Err(damaged(path, format!("there is no vertex {index} among {vertices}"))),
        None => Ok(order),
    }
}
