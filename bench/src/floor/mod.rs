//! Lower bounds of the time: hand-written plane tests for the widest registers of the processor, without the
//! other parts of an engine. They use fused multiply-add, which the engine must not.

pub mod planes;
pub mod ring;

/// Width of the registers in use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Eight numbers at a time.
    Avx512,
    /// Four at a time.
    Avx2,
    /// Plain loops, vectorised by the compiler.
    Portable,
}

impl Level {
    /// The best level of this processor.
    pub fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        if std::is_x86_feature_detected!("fma") {
            if std::is_x86_feature_detected!("avx512f")
                && std::is_x86_feature_detected!("avx512vl")
                && std::is_x86_feature_detected!("avx512dq")
                && std::is_x86_feature_detected!("avx512bw")
            {
                return Self::Avx512;
            }
            if std::is_x86_feature_detected!("avx2") {
                return Self::Avx2;
            }
        }
        Self::Portable
    }
}
