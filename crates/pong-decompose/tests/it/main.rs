//! Tests of decomposition and of contact on its results.

mod decompose;
mod decomposed_contact;
