//! The C functions of both versions of the standard.
//!
//! # Safety of all functions
//!
//! A pointer is NULL or points to what its type says, for as long as the call runs; an instance or a state
//! was returned by this library and not freed; text ends with a zero byte; an array has as many elements as
//! the importer says; an instance is called from one thread at a time. Everything else is checked.

/// Defines functions that call an instance, each under one or more names. In a body `FUNCTION` is the name.
macro_rules! calls {
    ($(fn $($name:ident),+ ($($arguments:tt)*) |$instance:ident| $body:expr;)*) => {$(
        calls!(@named [$($name)+] ($($arguments)*) |$instance| $body);
    )*};
    (@named [$($name:ident)+] $arguments:tt |$instance:ident| $body:expr) => {$(
        calls!(@one $name $arguments |$instance| $body);
    )+};
    (@one $name:ident ($($argument:ident: $type:ty),*) |$instance:ident| $body:expr) => {
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $name(component: *mut c_void $(, $argument: $type)*) -> Status {
            #[allow(dead_code, reason = "not every body tells its name")]
            const FUNCTION: &str = stringify!($name);
            // SAFETY: by the contract of this module.
            unsafe { call(component, |$instance: &mut Instance| $body) }
        }
    };
}

mod both;
mod component;
mod fmi2;
mod fmi3;
mod logger;
mod pointers;
