//! W17: orders of contact motions.

use crate::case::Case;
use crate::orders;

pub const W17: Case = Case {
    id: "W17",
    title: "Orders of contact motions",
    set_up: "1 kg on 1e4 N/m, from several phases of the step where contact begins: worst error in place, velocity and spin at a \
             step, half and a quarter of it, 1 ms under Runge-Kutta with contact at every stage, 0.2 ms else.\n\n\
             ![Worst error of every motion against the step, for three integrators](figures/orders.svg)",
    source: "the orders that the theory manual promises (section 4); errors against Runge-Kutta at 16 µs, at 4 µs where the \
             force jumps at break-away. An order above the promised one passes",
    rows: orders::rows,
};
