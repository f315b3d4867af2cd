// The lists beside the picture: bodies, and the contacts of the frame.

import { stateOf } from "#view/contacts.js";
import { bodyColors } from "#view/theme.js";
import { count, digits, fixed, quantity } from "#view/units.js";

/** Most rows of contacts in the table; the number of the others is shown below it. */
const ROWS = 200;

const element = (tag, properties = {}, ...children) => {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...children);
    return made;
};

const swatch = (color) => {
    const made = element("span", { className: "swatch" });
    made.style.background = color;
    return made;
};

/** The bodies: one is picked, each can be hidden. */
export class BodyList {
    constructor(list, run, { onPick, onShow }) {
        this.list = list;
        const colors = bodyColors(run.bodies);
        this.items = run.bodies.map((body, index) => {
            const shown = element("input", { type: "checkbox", checked: true, title: "Show this body" });
            shown.setAttribute("aria-label", `Show ${body.name}`);
            shown.addEventListener("change", () => onShow(index, shown.checked));
            const name = element("button", { type: "button", className: "name", title: body.name }, swatch(colors[index]), body.name);
            name.addEventListener("click", () => onPick(index));
            return element("li", {}, name, shown);
        });
        list.replaceChildren(...this.items);
    }

    pick(index) {
        this.items.forEach((item, at) => {
            item.classList.toggle("picked", at === index);
            item.firstChild.setAttribute("aria-pressed", String(at === index));
        });
        // Only the list scrolls, not its container.
        const { list } = this, { offsetTop, offsetHeight } = this.items[index];
        const top = offsetTop - list.offsetTop;
        list.scrollTop = Math.min(Math.max(list.scrollTop, top + offsetHeight - list.clientHeight), top);
    }
}

/** The picked body in numbers. */
export function describeBody(box, run, body, player, series) {
    const { frame } = player;
    const place = run.absolute(frame, body);
    const at = 4 * (frame * run.bodies.length + body);
    const turn = run.frames.orientation.subarray(at, at + 4);
    const { force, moment, depth } = series.of(body);
    const rows = [
        ["Position, m", place.map((x) => fixed(x, Math.abs(x) >= 1e5 ? 3 : 4)).join("  ")],
        ["Attitude w x y z", [...turn].map((x) => fixed(x, 4)).join("  ")],
        ["Force x y z, N", force.components.map((x) => digits(x[frame])).join("  ")],
        ["Moment x y z, N·m", moment.components.map((x) => digits(x[frame])).join("  ")],
        ["Largest depth", quantity(depth.size[frame], "m")],
    ];
    box.replaceChildren(
        ...rows.flatMap(([name, text]) => [element("dt", {}, name), element("dd", {}, text)]),
    );
}

/** The contacts of the frame, strongest first. */
export class ContactList {
    constructor(body, more, run, { onSelect, onVisit }) {
        Object.assign(this, { body, more, run, onSelect, rows: [], selected: null, colors: bodyColors(run.bodies) });
        body.addEventListener("click", (event) => this.#toggle(event.target.closest("tr")));
        body.addEventListener("dblclick", (event) => {
            const row = event.target.closest("tr");
            if (row) onVisit(row.dataset.key);
        });
        body.addEventListener("keydown", (event) => {
            if (event.key !== "Enter" && event.key !== " ") return;
            event.preventDefault();
            event.stopPropagation();
            this.#toggle(event.target.closest("tr"));
        });
    }

    #toggle(row) {
        if (row) this.onSelect(row.dataset.key === this.selected ? null : row.dataset.key);
    }

    show(contacts, selected) {
        this.selected = selected;
        const strongest = [...contacts].sort((a, b) => b.normalForce - a.normalForce || b.frictionForce - a.frictionForce).slice(0, ROWS);
        while (this.rows.length < strongest.length) this.rows.push(this.#row());
        strongest.forEach((contact, index) => this.#fill(this.rows[index], contact, contact.key === selected));
        const missing = this.rows.slice(0, strongest.length);
        if (this.body.childElementCount !== missing.length) this.body.replaceChildren(...missing);
        const left = contacts.length - strongest.length;
        this.more.textContent = left ? `and ${count(left)} weaker ones` : contacts.length ? "" : "No contact in this frame.";
    }

    #row() {
        const cells = Array.from({ length: 5 }, () => element("td"));
        const row = element("tr", { tabIndex: 0 }, ...cells);
        const names = [element("span", { className: "side" }), element("span", { className: "side" })];
        cells[0].append(...names);
        return Object.assign(row, { cells_: cells, names_: names });
    }

    #fill(row, contact, isSelected) {
        row.dataset.key = contact.key;
        row.classList.toggle("picked", isSelected);
        row.setAttribute("aria-selected", String(isSelected));
        const [pair, ...numbers] = row.cells_;
        const full = [this.#full(contact, "a"), this.#full(contact, "b")];
        row.names_.forEach((name, index) => {
            const { body } = index ? contact.b : contact.a;
            name.style.borderColor = this.colors[body];
            name.textContent = index ? contact.nameB : contact.nameA;
        });
        const share = contact.isCell
            ? `effective area ${digits(contact.weight * 1e4)} cm², pressure ${quantity(contact.normalForce / contact.weight, "Pa")}`
            : contact.isFriction ? "friction of the pair" : `share of the pair's spring ${digits(contact.weight)}`;
        pair.title = `A  ${full[0]}\nB  ${full[1]}, ${contact.feature}\n${share}\nrate ${digits(contact.rate * 1e3)} mm/s, slip ${digits(contact.slipSpeed * 1e3)} mm/s`;
        const texts = [
            contact.isFriction ? "–" : digits(contact.depth * 1e3), contact.isFriction ? "–" : digits(contact.normalForce),
            contact.isCell ? "–" : digits(contact.frictionForce),
            contact.isCell ? quantity(contact.normalForce / contact.weight, "Pa", 3) : stateOf(contact),
        ];
        texts.forEach((text, index) => {
            if (numbers[index].textContent !== text) numbers[index].textContent = text;
        });
        numbers[3].className = contact.isCell ? "" : stateOf(contact);
    }

    #full(contact, side) {
        const { body, info } = contact[side];
        const triangle = info.kind === "Triangle" ? `, triangle ${side === "a" ? contact.elementA : contact.elementB}` : "";
        return `${this.run.bodies[body].name} · ${info.path} (${info.kind}, ${info.surface})${triangle}`;
    }
}

