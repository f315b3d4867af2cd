//! Tests of the program `pong`, as a user runs it.

mod advise;
mod allowed_folders;
mod commands;
mod common;
mod decompose;
mod doctor;
mod fit;
mod fmu;
mod import;
mod interface;
mod join;
mod left_out;
mod man_pages;
mod modes;
mod replay;
mod solids;
mod step_warnings;
mod terminal;
mod trade;
mod tune;
mod users_guide;
mod verify;
mod view;
