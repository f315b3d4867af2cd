//! Tables and plots of reports: aligned text, Markdown and SVG, for any numbers.

#![forbid(unsafe_code)]

pub mod svg;
pub mod table;
