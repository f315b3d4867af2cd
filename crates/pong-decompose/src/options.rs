//! Options of a decomposition.

use pong_import::Findings;

/// Program that finds the cuts.
#[derive(Clone, Debug, PartialEq)]
pub enum Method {
    /// VHACD of the parry3d crate, built in.
    Vhacd,
    /// The Python package CoACD, run by this interpreter.
    Coacd(String),
}

/// Options of a decomposition.
#[derive(Clone, Debug)]
pub struct DecomposeOptions {
    /// Options of reading the mesh and building the model; those of parts, roots and mesh files are ignored.
    pub import: pong_import::Options,
    /// Program that finds the cuts.
    pub method: Method,
    /// VHACD: voxels along the longest side. CoACD: samples on the surface. `None` means 100 and 2000.
    pub resolution: Option<u32>,
    /// VHACD: share of the whole hull's volume by which a piece may exceed its content. CoACD: its threshold.
    /// `None` means 0.005 and 0.05.
    pub concavity: Option<f64>,
    /// Largest protrusion of a piece, m: pieces are cut until it holds or `pieces_max` is reached, so holes
    /// wider than twice this stay open. `None` leaves the cuts to the method.
    pub fit_m: Option<f64>,
    /// Most pieces.
    pub pieces_max: usize,
    /// Largest accepted protrusion and deficit, m.
    pub within_m: Option<f64>,
    /// Sample points on each surface and in the volume.
    pub samples: usize,
}

impl Default for DecomposeOptions {
    fn default() -> Self {
        Self {
            import: pong_import::Options::default(),
            method: Method::Vhacd,
            resolution: None,
            concavity: None,
            fit_m: None,
            pieces_max: 64,
            within_m: None,
            samples: 30_000,
        }
    }
}

impl DecomposeOptions {
    /// Reports values outside their range.
    pub(crate) fn check(&self, file: &str, findings: &mut Findings) -> Option<()> {
        let mut refuse = |bad: bool, what: String, cure: &str| {
            if bad {
                findings.fault(file, "option", what, cure);
            }
        };
        let above_zero = |x: f64| x > 0.0 && x.is_finite();
        refuse(
            !above_zero(self.import.unit_m),
            format!("a unit of {} m", self.import.unit_m),
            "give metres above zero",
        );
        if let Some(concavity) = self.concavity {
            refuse(!(0.0..=1.0).contains(&concavity), format!("a concavity of {concavity}"), "give 0 to 1");
        }
        if let (Some(voxels), Method::Vhacd) = (self.resolution, &self.method) {
            refuse(
                !(8..=1000).contains(&voxels),
                format!("a resolution of {voxels} voxels"),
                "give 8 to 1000",
            );
        }
        if let (Some(concavity), Method::Coacd(_)) = (self.concavity, &self.method) {
            refuse(concavity < 0.01, format!("a CoACD threshold of {concavity}"), "give 0.01 to 1");
        }
        if let Some(fit_m) = self.fit_m {
            let cause = format!("pieces that protrude by at most {fit_m} m");
            refuse(!above_zero(fit_m), cause, "give metres above zero");
            let with = self.concavity.is_some() || self.resolution.is_some() || self.method != Method::Vhacd;
            let cause = "cuts by --fit and by --concavity, --resolution or CoACD".to_owned();
            refuse(with, cause, "choose one: --fit needs --pieces-max alone");
        }
        refuse(self.pieces_max == 0, "no pieces at all".to_owned(), "allow one piece or more");
        refuse(self.samples == 0, "no samples at all".to_owned(), "allow some thousands");
        if let Some(within_m) = self.within_m {
            refuse(!above_zero(within_m), format!("a limit of {within_m} m"), "give metres above zero");
        }
        findings.faults.is_empty().then_some(())
    }
}
