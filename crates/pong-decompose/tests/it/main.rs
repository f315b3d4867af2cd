//! Tests of decomposition and of contact on what it makes.

mod decompose;
mod decomposed_contact;
