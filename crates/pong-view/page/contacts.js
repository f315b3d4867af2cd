// Contacts of a frame as things to draw and to list.

/** Key of a contact that stays the same from frame to frame. */
export const keyOf = (run, row) => {
    const { pair, primitive_a, primitive_b, element_a, element_b, end, feature } = run.contacts;
    // The contacts of two solids differ in their features, those of other pairs in their elements and ends.
    const part = end[row] >>> 31 ? feature[row] : 0;
    return [pair[row], primitive_a[row], primitive_b[row], element_a[row], element_b[row], end[row], part].join(":");
};

/** Word for what friction does; cells of solids have none. */
export const stateOf = ({ isCell, sticks }) => (isCell ? "–" : sticks ? "stick" : "slip");

/** One contact, vectors along the common axes, forces on A. */
export function contactAt(run, row) {
    const c = run.contacts;
    const vector = (column) => [column[3 * row], column[3 * row + 1], column[3 * row + 2]];
    const friction = vector(c.friction), slip = vector(c.slip);
    return {
        row,
        pair: c.pair[row],
        isCell: run.isCell(row),
        isFriction: run.isFriction(row),
        key: keyOf(run, row),
        a: run.primitive(c.primitive_a[row]),
        b: run.primitive(c.primitive_b[row]),
        nameA: run.partName(c.primitive_a[row]),
        nameB: run.partName(c.primitive_b[row]),
        elementA: c.element_a[row],
        elementB: c.element_b[row],
        feature: `${["face", "edge", "vertex", "feature"][(c.flags[row] >> 2) & 3]} ${c.feature[row]}`,
        sticks: (c.flags[row] & 1) === 1,
        point: vector(c.point),
        normal: vector(c.normal),
        depth: c.depth[row],
        rate: c.rate[row],
        weight: c.weight[row],
        normalForce: c.normal_force[row],
        friction,
        frictionForce: Math.hypot(...friction),
        slip,
        slipSpeed: Math.hypot(...slip),
    };
}

/** The contacts of a frame. */
export function contactsIn(run, frame) {
    const [from, to] = run.contactsOf(frame);
    return Array.from({ length: to - from }, (_, index) => contactAt(run, from + index));
}

/** Most contacts sampled for the size of forces. */
const SAMPLES = 20000;

/** The 90th percentile of the contact forces, and the largest, N. */
export function typicalForces(run) {
    const { normal_force: forces } = run.contacts;
    const step = Math.max(1, Math.ceil(forces.length / SAMPLES));
    const some = [];
    let largest = 0;
    forces.forEach((force, row) => {
        largest = Math.max(largest, force);
        if (row % step === 0 && force > 0) some.push(force);
    });
    some.sort((a, b) => a - b);
    return { usual: some[Math.floor(0.9 * some.length)] ?? largest, largest };
}
