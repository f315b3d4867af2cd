//! `pong join`: several models that never move relative to each other become one.

use crate::folders::AllowedFolders;
use crate::terminal::{Outcome, failure, print, tell, tell_lines, unwritable};
use pong_geometry::{Pose, Quat, Vec3};
use pong_model::join::{Source, join};
use pong_model::{Model, authored, printable, write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Joins models that never move relative to each other into one, so that flush faces of theirs are one surface.
///
/// Contacts on one surface share one spring; over a seam of two Objects, or of two surfaces, springs add, and what
/// rolls over it hops. The root of each model becomes a group of the new root. Movable groups below it stay movable.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The model file to write.
    #[arg(value_name = "OUT.ron")]
    output: PathBuf,
    /// The models, each with its position in m, and its orientation as a quaternion: part.ron@0,1.5,0 or
    /// part.ron@0,1.5,0,1,0,0,0. A model may be named several times.
    #[arg(value_name = "MODEL.ron[@X,Y,Z[,QW,QX,QY,QZ]]", required = true, value_parser = placed)]
    models: Vec<Placed>,
    /// Name of the new model; that of the file unless given.
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// Does not declare the new root one surface.
    #[arg(long)]
    separate: bool,
    /// Replaces an existing file.
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    allowed: AllowedFolders,
}

/// Model file and the pose of its root.
#[derive(Clone, Debug)]
struct Placed {
    path: PathBuf,
    pose: Pose,
}

/// Path and pose from an argument.
fn placed(text: &str) -> Result<Placed, String> {
    let (path, place) = match text.rsplit_once('@') {
        Some((path, place)) if place.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) => {
            (path, place)
        }
        _ => return Ok(Placed { path: text.into(), pose: Pose::identity() }),
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
    Ok(Placed { path: path.into(), pose: Pose { position, orientation } })
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let Arguments { output, models, separate, force, .. } = arguments;
    if output.exists() && !force {
        return Err(failure(format!("{} is there already; --force replaces it", output.display())));
    }
    let extensions = arguments.allowed.extensions();
    let mut read: Vec<(String, authored::Node, Model)> = Vec::new();
    for placed in models {
        let loaded = authored::load(&placed.path)
            .and_then(|node| Ok((node, pong_model::load(&placed.path, &extensions)?)));
        match loaded {
            Ok((document, model)) => read.push((free_name(&read, &model.name), document, model)),
            Err(errors) => {
                tell_lines(&errors);
                return Err(failure("nothing is written"));
            }
        }
    }
    let folder = output.parent().unwrap_or(Path::new(""));
    let meshes: Vec<Option<String>> = models.iter().map(|placed| below(folder, &placed.path)).collect();
    let sources: Vec<Source<'_>> = read
        .iter()
        .zip(models.iter().zip(&meshes))
        .map(|((name, document, model), (placed, meshes))| Source {
            name,
            document,
            model,
            pose: placed.pose,
            meshes: meshes.as_deref(),
        })
        .collect();
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    let name = arguments.name.as_deref().unwrap_or(&stem);
    let text = write::text(&join(name, &sources, !separate).map_err(failure)?);
    let model = match pong_model::parse(&text, &output.display().to_string(), Some(folder), &extensions) {
        Ok(model) => model,
        Err(errors) => {
            tell_lines(&errors);
            return Err(failure("the joined model is refused; nothing is written"));
        }
    };
    std::fs::write(output, text).map_err(|reason| unwritable(output, &reason))?;
    model.warnings.iter().for_each(|warning| tell(format!("warning: {}", printable(warning))));
    print(&format!("written: {}\n", output.display()));
    Ok(ExitCode::SUCCESS)
}

/// Name of a group that no earlier model has: that of the model, with a number if need be.
fn free_name(earlier: &[(String, authored::Node, Model)], name: &str) -> String {
    let own = name.replace('/', "_");
    let numbered = (2..).map(|number| format!("{own}_{number}"));
    let mut names = std::iter::once(own.clone()).chain(numbered);
    names.find(|name| earlier.iter().all(|(taken, _, _)| taken != name)).unwrap_or_default()
}

/// Path from a folder to the folder of a file, ending in `/`; empty for the same folder. `None` if the file is not
/// below the folder.
fn below(folder: &Path, file: &Path) -> Option<String> {
    let whole =
        |folder: &Path| std::fs::canonicalize(if folder == Path::new("") { Path::new(".") } else { folder });
    let (folder, of_file) = (whole(folder).ok()?, whole(file.parent()?).ok()?);
    let names =
        of_file.strip_prefix(folder).ok()?.iter().map(|name| name.to_str().map(|name| format!("{name}/")));
    names.collect()
}
