//! Positions and indices of a primitive, checked before they are read.

use crate::findings::Finding;
use ::gltf::accessor::{DataType, Dimensions, Item, Iter};
use ::gltf::mesh::Primitive;
use nalgebra::Vector3;

fn damaged(path: &str, cause: String) -> Finding {
    let cure = "export it again".to_owned();
    Finding { path: path.to_owned(), rule: "damaged", cause, cure }
}

fn bytes_of<'b>(buffers: &'b [Vec<u8>]) -> impl Clone + Fn(::gltf::Buffer<'_>) -> Option<&'b [u8]> {
    |buffer: ::gltf::Buffer<'_>| buffers.get(buffer.index()).map(Vec::as_slice)
}

/// Checks that the buffers can hold an accessor's count. Without a view all elements are zero except sparse
/// ones, so a short file could demand any amount of memory.
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

/// Positions of a primitive, in the precision of the file.
pub(super) enum Positions {
    Single(Vec<[f32; 3]>),
    /// Normalized integers.
    Double(Vec<Vector3<f64>>),
}

impl Positions {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Single(places) => places.len(),
            Self::Double(places) => places.len(),
        }
    }
}

/// The larger of the declared numbers of positions and of indices.
pub(super) fn length(primitive: &Primitive<'_>, buffers: &[Vec<u8>], path: &str) -> Result<usize, Finding> {
    let mut length = 0;
    let positions = primitive.get(&::gltf::Semantic::Positions).map(|accessor| (accessor, "positions"));
    let indices = primitive.indices().map(|accessor| (accessor, "indices"));
    for (accessor, what) in positions.into_iter().chain(indices) {
        check_count(&accessor, buffers, what, path)?;
        length = length.max(accessor.count());
    }
    Ok(length)
}

/// Positions, whose number was checked by [`length`]: floats, or the integers of KHR_mesh_quantization.
pub(super) fn positions(
    primitive: &Primitive<'_>,
    buffers: &[Vec<u8>],
    path: &str,
) -> Result<Positions, Finding> {
    let Some(accessor) = primitive.get(&::gltf::Semantic::Positions) else {
        let cause = format!("primitive {} of its mesh has no positions", primitive.index());
        return Err(damaged(path, cause));
    };
    if accessor.count() == 0 {
        return Ok(Positions::Single(Vec::new()));
    }
    if accessor.dimensions() != Dimensions::Vec3 {
        return Err(damaged(path, "its positions are not three numbers each".to_owned()));
    }
    let whole = accessor.normalized();
    let places = match accessor.data_type() {
        DataType::F32 => all::<f32>(&accessor, buffers).map(Positions::Single),
        DataType::I8 => integers::<i8>(&accessor, buffers, whole.then_some(f64::from(i8::MAX))),
        DataType::U8 => integers::<u8>(&accessor, buffers, whole.then_some(f64::from(u8::MAX))),
        DataType::I16 => integers::<i16>(&accessor, buffers, whole.then_some(f64::from(i16::MAX))),
        DataType::U16 => integers::<u16>(&accessor, buffers, whole.then_some(f64::from(u16::MAX))),
        DataType::U32 => {
            let cause = "its positions are 32-bit integers, which no extension of glTF allows";
            return Err(damaged(path, cause.to_owned()));
        }
    };
    match places {
        Some(places) if places.len() == accessor.count() => Ok(places),
        _ => Err(damaged(path, "its positions lie outside their buffer".to_owned())),
    }
}

fn all<T: Copy>(accessor: &::gltf::Accessor<'_>, buffers: &[Vec<u8>]) -> Option<Vec<[T; 3]>>
where
    [T; 3]: Item,
{
    Iter::<[T; 3]>::new(accessor.clone(), bytes_of(buffers)).map(Iterator::collect)
}

/// Integers as they are, or normalized by the largest; the least signed integer becomes −1, as its neighbour
/// does.
fn integers<T: Copy + Into<f64> + Into<f32>>(
    accessor: &::gltf::Accessor<'_>,
    buffers: &[Vec<u8>],
    largest: Option<f64>,
) -> Option<Positions>
where
    [T; 3]: Item,
{
    let places = all::<T>(accessor, buffers)?.into_iter();
    Some(match largest {
        None => Positions::Single(places.map(|place| place.map(Into::into)).collect()),
        Some(largest) => {
            let fraction = |x: T| (Into::<f64>::into(x) / largest).max(-1.0);
            Positions::Double(places.map(|place| Vector3::from(place.map(fraction))).collect())
        }
    })
}

/// Corners in order; every position once if there are no indices. Their number was checked by [`length`].
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
