//! Values of a table's fields: their NumPy types and bytes.

/// Type of a field of a table. Little endian.
pub trait Value: Copy {
    /// NumPy's name of its number type.
    const KIND: &'static str;
    /// Length of its array; 0 for a single number.
    const COUNT: usize;
    /// Bytes of a value.
    const SIZE: usize;

    /// Appends the bytes to `out`.
    fn put(self, out: &mut Vec<u8>);
    /// Reads the value from the first bytes.
    fn get(bytes: &[u8]) -> Self;
    /// True if two values agree; floating-point numbers are compared by `same`.
    fn agrees(&self, other: &Self, same: &dyn Fn(f64, f64) -> bool) -> bool;
    /// The value in words; different values give different words.
    fn words(&self) -> String;
    /// The largest magnitude in it; 0 for counts and indices.
    fn magnitude(&self) -> f64;
}

macro_rules! count {
    ($type:ty, $kind:literal) => {
        impl Value for $type {
            const KIND: &'static str = $kind;
            const COUNT: usize = 0;
            const SIZE: usize = size_of::<$type>();

            fn put(self, out: &mut Vec<u8>) {
                out.extend_from_slice(&self.to_le_bytes());
            }

            fn get(bytes: &[u8]) -> Self {
                let mut own = [0; Self::SIZE];
                own.copy_from_slice(&bytes[..Self::SIZE]);
                Self::from_le_bytes(own)
            }

            fn agrees(&self, other: &Self, _: &dyn Fn(f64, f64) -> bool) -> bool {
                self == other
            }

            fn words(&self) -> String {
                self.to_string()
            }

            fn magnitude(&self) -> f64 {
                0.0
            }
        }
    };
}

count!(u32, "<u4");
count!(u64, "<u8");

impl Value for f64 {
    const KIND: &'static str = "<f8";
    const COUNT: usize = 0;
    const SIZE: usize = 8;

    fn put(self, out: &mut Vec<u8>) {
        out.extend_from_slice(&self.to_le_bytes());
    }

    fn get(bytes: &[u8]) -> Self {
        Self::from_bits(u64::get(bytes))
    }

    fn agrees(&self, other: &Self, same: &dyn Fn(f64, f64) -> bool) -> bool {
        same(*self, *other)
    }

    fn words(&self) -> String {
        format!("{self:?}")
    }

    fn magnitude(&self) -> f64 {
        self.abs()
    }
}

impl<const N: usize> Value for [f64; N] {
    const KIND: &'static str = "<f8";
    const COUNT: usize = N;
    const SIZE: usize = 8 * N;

    fn put(self, out: &mut Vec<u8>) {
        self.into_iter().for_each(|x| x.put(out));
    }

    fn get(bytes: &[u8]) -> Self {
        std::array::from_fn(|index| f64::get(&bytes[8 * index..]))
    }

    fn agrees(&self, other: &Self, same: &dyn Fn(f64, f64) -> bool) -> bool {
        self.iter().zip(other).all(|(a, b)| same(*a, *b))
    }

    fn words(&self) -> String {
        format!("{self:?}")
    }

    fn magnitude(&self) -> f64 {
        self.iter().fold(0.0, |largest, x| x.abs().max(largest))
    }
}

/// A matrix, row by row.
impl<const M: usize, const N: usize> Value for [[f64; N]; M] {
    const KIND: &'static str = "<f8";
    const COUNT: usize = M * N;
    const SIZE: usize = 8 * M * N;

    fn put(self, out: &mut Vec<u8>) {
        self.into_iter().for_each(|row| row.put(out));
    }

    fn get(bytes: &[u8]) -> Self {
        std::array::from_fn(|row| Value::get(&bytes[8 * N * row..]))
    }

    fn agrees(&self, other: &Self, same: &dyn Fn(f64, f64) -> bool) -> bool {
        self.iter().zip(other).all(|(a, b)| a.agrees(b, same))
    }

    fn words(&self) -> String {
        format!("{self:?}")
    }

    fn magnitude(&self) -> f64 {
        self.iter().map(Value::magnitude).fold(0.0, f64::max)
    }
}
