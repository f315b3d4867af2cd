//! Tests of logs: recording, damage and replay.

mod cut_off;
mod replay;
mod round_trip;
mod support;
