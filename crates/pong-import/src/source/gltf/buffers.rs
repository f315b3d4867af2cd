//! Bytes of the buffers: in the file, in the text, or in files beside it.

use crate::findings::Finding;
use base64::Engine;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

pub(super) fn load(
    document: &::gltf::Document,
    mut blob: Option<Vec<u8>>,
    path: &Path,
    allowed: &[PathBuf],
) -> Result<Vec<Vec<u8>>, Finding> {
    let mut buffers = Vec::new();
    for buffer in document.buffers() {
        let bytes = match buffer.source() {
            ::gltf::buffer::Source::Bin => blob.take().ok_or_else(|| "the binary part is missing".to_owned()),
            ::gltf::buffer::Source::Uri(uri) => from_uri(uri, path, allowed),
        };
        let bytes = bytes.and_then(|bytes| match bytes.len() < buffer.length() {
            true => Err(format!("it has {} bytes instead of {}", bytes.len(), buffer.length())),
            false => Ok(bytes),
        });
        buffers.push(bytes.map_err(|reason| Finding {
            path: path.display().to_string(),
            rule: "buffer",
            cause: format!("buffer {} cannot be read: {reason}", buffer.index()),
            cure: "put the .bin file beside the .gltf file, or export as .glb".to_owned(),
        })?);
    }
    Ok(buffers)
}

fn from_uri(uri: &str, path: &Path, allowed: &[PathBuf]) -> Result<Vec<u8>, String> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (head, text) = data.split_once(',').ok_or("its data: address has no comma")?;
        if !head.ends_with(";base64") {
            return Err("its data: address is not base64".to_owned());
        }
        return base64::engine::general_purpose::STANDARD.decode(text).map_err(|reason| reason.to_string());
    }
    if uri.contains("://") {
        return Err(format!("{uri} is not a file"));
    }
    let name =
        percent_encoding::percent_decode_str(uri).decode_utf8().map_err(|reason| reason.to_string())?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let folders = std::iter::once(folder).chain(allowed.iter().map(PathBuf::as_path));
    pong_model::files::read_below(&folder.join(name.as_ref()), folders).map_err(|reason| {
        let cure = match reason.kind() {
            ErrorKind::PermissionDenied => "; allow its folder with --allow-files-below if that is meant",
            _ => "",
        };
        format!("{uri}: {reason}{cure}")
    })
}
