//! Tables and plots of reports: aligned text, Markdown and SVG. Nothing here knows what the numbers mean.

#![forbid(unsafe_code)]

pub mod svg;
pub mod table;
