// Puts the page together: what is shown follows from the moment, the picked body and the selected contact.

import { Raycaster, Vector2, Vector3 } from "three";
import { ContactMarks, signFor } from "#view/arrows.js";
import { Bodies } from "#view/bodies.js";
import { CameraControl } from "#view/camera.js";
import { contactsIn, stateOf, typicalForces } from "#view/contacts.js";
import { load } from "#view/data.js";
import { Highlights } from "#view/highlight.js";
import { bindKeys } from "#view/keys.js";
import { BodyList, ContactList, describeBody } from "#view/list.js";
import { patchesOf, rampGradient, typicalPressure } from "#view/patches.js";
import { Player } from "#view/player.js";
import { Plots } from "#view/plots.js";
import { Series } from "#view/series.js";
import { Stage } from "#view/stage.js";
import { initTheme, toggleTheme } from "#view/theme.js";
import { Transport } from "#view/transport.js";
import { count, digits, niceStep, quantity } from "#view/units.js";

/** Interval of updating the lists while a run plays, s. */
const LIST_PERIOD = 0.1;
/** Usual forces, and the largest of the run, are drawn at most as long as these shares of the bodies shown first. */
const USUAL_SHARE = 0.3, LARGEST_SHARE = 0.9;
/** Frames whose arrows are fitted into the picture at the start. */
const ARROW_FRAMES = 40, ARROWS = 4000;
const PICK_PIXELS = 12;

const byId = (id) => document.getElementById(id);

class Page {
    constructor(run) {
        this.run = run;
        this.player = new Player(run);
        this.series = new Series(run);
        this.stage = new Stage(byId("picture"));
        this.bodies = new Bodies(run);
        this.marks = new ContactMarks();
        this.highlights = new Highlights(this.bodies);
        this.stage.scene.add(this.bodies, this.marks);
        this.camera = new CameraControl(this.stage, this.bodies);
        this.transport = new Transport(run, this.player);
        this.plots = new Plots(byId("plot"), run, this.series, this.player);
        this.body = this.#busiest();
        this.selected = null;
        this.shownFrame = -1;
        this.listAge = Infinity;
        this.pressure = typicalPressure(run);
        this.#measureArrows();
        this.#showPressureScale();
        this.#buildLists();
        this.#bindControls();
        this.#bindKeys();
        this.#bindPicture();
        this.#describe();
        this.player.addEventListener("moment", () => this.#showMoment());
        this.player.addEventListener("manner", () => this.#showLists());
        document.addEventListener("theme", () => this.#recolor());
        this.stage.onTick = (seconds) => this.#tick(seconds);
        this.stage.onDraw = () => this.#beforePicture();
        this.pick(this.body);
        this.camera.frame(this.#subject(), "oblique");
        this.player.seekFrame(0);
        this.stage.run();
    }

    // The body with the largest force in the run, a moving one if there is.
    #busiest() {
        const { moving } = this.bodies;
        const peaks = moving.map((body) => this.series.of(body).force.size.reduce((a, b) => Math.max(a, b), 0));
        return moving[peaks.indexOf(Math.max(...peaks))] ?? 0;
    }

    #measureArrows() {
        this.bodies.show(0, 0);
        const { x, y, z } = this.bodies.box(this.bodies.moving).getSize(new Vector3());
        const size = Math.hypot(x, y, z) || this.bodies.size;
        const { usual, largest } = typicalForces(this.run);
        this.baseScale = largest > 0 ? Math.min((USUAL_SHARE * size) / usual, (LARGEST_SHARE * size) / largest) : 1;
    }

    // The target of the camera, with the arrows of some frames.
    #subject() {
        const { run, bodies } = this, places = bodies.subject;
        const last = run.frameCount - 1, step = Math.max(1, last / ARROW_FRAMES);
        const frames = bodies.isWayShort ? [this.#peakFrame()] : [0];
        for (let frame = 0; bodies.isWayShort && frame <= last; frame += step) frames.push(Math.round(frame));
        const contacts = frames.flatMap((frame) => contactsIn(run, frame));
        const some = Math.ceil(contacts.length / ARROWS);
        for (const contact of contacts.filter((_, index) => index % some === 0)) {
            const length = signFor(contact, this.body) * contact.normalForce * this.metresPerNewton;
            const point = new Vector3().fromArray(contact.point);
            places.push(point, point.clone().addScaledVector(new Vector3().fromArray(contact.normal), length));
        }
        return places;
    }

    #peakFrame() {
        const { size } = this.series.of(this.body).force;
        return size.reduce((best, value, frame) => (value > size[best] ? frame : best), 0);
    }

    get metresPerNewton() {
        return this.baseScale * 2 ** Number(byId("scale").value);
    }

    #buildLists() {
        this.bodyList = new BodyList(byId("bodies"), this.run, {
            onPick: (body) => this.pick(body),
            onShow: (body, isShown) => {
                this.bodies.views[body].isShown = isShown;
                this.#showMoment();
            },
        });
        this.contactList = new ContactList(byId("contacts"), byId("more"), this.run, {
            onSelect: (key) => this.select(key),
            onVisit: (key) => this.#visit(key),
        });
        byId("plot-body").replaceChildren(...this.run.bodies.map((body, index) => new Option(body.name, index)));
    }

    #bindControls() {
        const onChange = (id, action) => byId(id).addEventListener("change", (event) => action(event.target));
        onChange("side", ({ value }) => this.camera.frame(this.#subject(), value));
        onChange("camera", ({ value }) => this.camera.setMode(value, this.body));
        onChange("xray", ({ checked }) => (this.bodies.setXray(checked), this.stage.redraw()));
        onChange("edges", ({ checked }) => (this.bodies.setEdges(checked), this.stage.redraw()));
        onChange("highlight", ({ checked }) => ((this.highlights.isOn = checked), this.#showContacts()));
        onChange("normals", () => this.#showContacts());
        onChange("frictions", () => this.#showContacts());
        onChange("patches", () => this.#showContacts());
        onChange("plot-body", ({ value }) => this.pick(Number(value)));
        onChange("components", ({ checked }) => ((this.plots.hasComponents = checked), this.plots.refresh()));
        byId("scale").addEventListener("input", () => this.#showContacts());
        byId("frame-all").addEventListener("click", () => this.camera.frame(this.bodies.places()));
        byId("frame-body").addEventListener("click", () => this.camera.frame(this.bodies.places([this.body])));
        byId("theme").addEventListener("click", toggleTheme);
        byId("help-open").addEventListener("click", () => byId("help").showModal());
        byId("plot-all").addEventListener("click", () => this.plots.showAll());
        byId("to-peak").addEventListener("click", () => this.#toPeak());
    }

    #bindKeys() {
        const { player, transport } = this;
        const choose = (id) => {
            const select = byId(id);
            select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
            select.dispatchEvent(new Event("change"));
        };
        const rows = bindKeys({
            toggle: () => player.toggle(),
            step: (frames) => player.step(frames),
            first: () => player.seekFrame(0),
            last: () => player.seekFrame(this.run.frameCount - 1),
            change: (direction) => player.stepToChange(direction),
            peak: () => this.#toPeak(),
            speed: (steps) => transport.changeSpeed(steps),
            realTime: () => transport.realTime(),
            loop: () => byId("loop").click(),
            frameAll: () => byId("frame-all").click(),
            frameBody: () => byId("frame-body").click(),
            camera: () => choose("camera"),
            view: () => choose("side"),
            zoom: (steps) => this.camera.zoom(steps),
            flip: (id) => byId(id).click(),
            theme: toggleTheme,
            save: () => this.stage.save(`${this.run.about.name} ${byId("time").textContent}.png`),
            drop: () => this.select(null),
            help: () => byId("help").showModal(),
        });
        byId("keys").replaceChildren(
            ...rows.flatMap(([key, meaning]) => [
                Object.assign(document.createElement("dt"), { textContent: key }),
                Object.assign(document.createElement("dd"), { textContent: meaning }),
            ]),
        );
    }

    // A click that is no drag picks the contact under it, or else the body.
    #bindPicture() {
        const { canvas } = this.stage;
        let down = null;
        canvas.addEventListener("pointerdown", (event) => (down = event.button === 0 ? [event.offsetX, event.offsetY] : null));
        canvas.addEventListener("pointerup", (event) => {
            if (down && Math.hypot(event.offsetX - down[0], event.offsetY - down[1]) < 4) this.#pickAt(...down);
            down = null;
        });
    }

    #pickAt(x, y) {
        const distance = (contact) => {
            const [px, py] = this.project(contact.point);
            return Math.hypot(px - x, py - y);
        };
        const near = this.contacts.map((contact) => [distance(contact), contact]).filter(([d]) => d < PICK_PIXELS);
        if (near.length) return this.select(near.sort((a, b) => a[0] - b[0])[0][1].key);
        const { clientWidth: width, clientHeight: height } = this.stage.canvas;
        const ray = new Raycaster();
        ray.setFromCamera(new Vector2((2 * x) / width - 1, 1 - (2 * y) / height), this.stage.camera);
        const solids = this.bodies.views.filter((view) => view.visible).flatMap((view) => view.solids);
        const hit = ray.intersectObjects(solids, false)[0];
        if (hit) this.pick(hit.object.userData.body);
    }

    /** Picks a body: its plots, its numbers, the forces on it. */
    pick(body) {
        this.body = body;
        this.bodyList.pick(body);
        byId("plot-body").value = body;
        this.camera.setMode(this.camera.mode, body);
        this.plots.setBody(body);
        this.shownFrame = -1;
        this.#showMoment();
    }

    /** Selects a contact by its key, or none. */
    select(key) {
        this.selected = key;
        this.#showContacts();
        this.#showLists();
    }

    #visit(key) {
        this.select(key);
        const contact = this.contacts.find((contact) => contact.key === key);
        if (contact) this.camera.lookAt(new Vector3().fromArray(contact.point), this.camera.distance / 4);
    }

    #toPeak() {
        this.player.pause();
        this.player.seekFrame(this.#peakFrame());
    }

    #tick(seconds) {
        if (!this.player.isPlaying) return false;
        this.listAge += seconds;
        this.player.advance(seconds);
        return true;
    }

    #showMoment() {
        const { player } = this;
        this.bodies.show(player.frame, player.fraction);
        this.camera.update();
        if (player.frame !== this.shownFrame) this.#showContacts();
        this.shownFrame = player.frame;
        this.transport.showMoment();
        this.plots.draw();
        if (!player.isPlaying || this.listAge >= LIST_PERIOD) this.#showLists();
        this.stage.redraw();
    }

    #showContacts() {
        this.contacts = contactsIn(this.run, this.player.frame);
        this.patches = patchesOf(this.contacts);
        this.marks.show(this.contacts, this.patches, this.metresPerNewton, this.body, this.selected, {
            pressure: byId("patches").checked ? this.pressure : 0,
            hasNormals: byId("normals").checked,
            hasFriction: byId("frictions").checked,
        });
        this.highlights.show(this.contacts);
        this.#showScale();
        this.stage.redraw();
    }

    // The scale of pressure, which a run without solids does not have.
    #showPressureScale() {
        byId("patches-legend").hidden = !(this.pressure > 0);
        byId("pressure-ramp").style.background = rampGradient();
        byId("pressure-scale").textContent = `0 … ${quantity(this.pressure, "Pa", 3)}`;
    }

    // A round force and the length of its arrow.
    #showScale() {
        const force = niceStep(0.6 * this.bodies.size / this.metresPerNewton, 4);
        byId("scale-text").textContent = `${quantity(force, "N", 2)} ≙ ${quantity(force * this.metresPerNewton, "m", 3)}`;
        byId("sense").textContent = `forces on ${this.run.bodies[this.body].name}, elsewhere on A`;
    }

    #showLists() {
        this.listAge = 0;
        this.contactList.show(this.contacts, this.selected);
        describeBody(byId("body-facts"), this.run, this.body, this.player, this.series);
        const flags = this.run.frames.flags[this.player.frame];
        const limits = [flags & 1 && "contact limit", flags & 2 && "load sharing limit", flags & 4 && "went through"];
        const left = limits.filter(Boolean).join(", ");
        byId("contact-count").textContent = count(this.contacts.length) + (left ? ` (${left})` : "");
    }

    #beforePicture() {
        this.stage.setDepth(this.camera.distance);
        this.marks.fit(this.stage.camera, this.stage.pixel);
        const label = byId("label");
        const contact = this.contacts.find((contact) => contact.key === this.selected);
        label.hidden = !contact;
        if (!contact) return;
        const [x, y] = this.project(contact.point);
        Object.assign(label.style, { left: `${x}px`, top: `${y}px` });
        label.textContent = `${contact.nameA} – ${contact.nameB}\n${labelOf(contact)}`;
    }

    #recolor() {
        this.stage.recolor();
        this.bodies.recolor();
        this.marks.recolor();
        this.transport.drawStrip();
        this.plots.refresh();
    }

    #describe() {
        const { run } = this, { about } = run;
        const facts = [
            run.isByTime ? `${quantity(run.end - run.start, "s", 3)}` : "",
            `${count(run.frameCount)} frames`,
            about.step ? `step ${quantity(about.step, "s", 3)}` : "",
            about.integrator ?? "",
            about.writer,
        ];
        byId("facts").textContent = facts.filter(Boolean).join("  ·  ");
        byId("notes").replaceChildren(
            ...about.notes.map((note) => Object.assign(document.createElement("li"), { textContent: note })),
        );
        byId("plot-note").textContent = about.every > 1 ? "pale: peaks of all frames" : "";
    }

    /** Position of a point in the picture, px from its top left corner. */
    project(place) {
        const { camera, canvas } = this.stage;
        camera.updateMatrixWorld();
        const at = new Vector3().fromArray(place).project(camera);
        return [((at.x + 1) / 2) * canvas.clientWidth, ((1 - at.y) / 2) * canvas.clientHeight];
    }
}

/** Numbers of a contact for its label. */
function labelOf(contact) {
    const { normalForce, depth, frictionForce, weight } = contact;
    if (contact.isFriction) return `${quantity(frictionForce, "N")} of friction, ${stateOf(contact)}`;
    const state = contact.isCell ? `${quantity(normalForce / weight, "Pa")} on ${digits(weight * 1e4)} cm²` : stateOf(contact);
    return `${quantity(normalForce, "N")}, ${quantity(depth, "m")}, ${state}`;
}

/** Interface of the page for the console and tests. */
function interfaceOf(page) {
    const { run, player, stage, bodies } = page;
    const index = (name) => {
        const found = run.bodies.findIndex((body) => body.name === name);
        if (found < 0) throw new Error(`there is no body ${name}; there are ${run.bodies.map((body) => body.name).join(", ")}`);
        return found;
    };
    return {
        about: run.about,
        frameCount: run.frameCount,
        bodies: run.bodies.map((body) => body.name),
        time: () => player.time,
        frame: () => player.frame,
        seek: (time) => player.seek(time),
        seekFrame: (frame) => player.seekFrame(frame),
        play: () => player.play(),
        pause: () => player.pause(),
        isPlaying: () => player.isPlaying,
        /** Drawn position of a body in the common frame, m. */
        position: (name) => {
            const origin = run.originOf(player.frame), { position } = bodies.views[index(name)];
            return [origin[0] + position.x, origin[1] + position.y, origin[2] + position.z];
        },
        /** Position of a body's origin in the picture, px. */
        projected: (name) => page.project(bodies.views[index(name)].position.toArray()),
        contacts: () => page.contacts,
        patches: () => page.patches,
        arrows: () => page.marks.arrowCount,
        highlighted: () => page.highlights.count,
        /** Position of a point of the scene in the picture, px. */
        project: (place) => page.project(place),
        pick: (name) => page.pick(index(name)),
        select: (key) => page.select(key),
        picturesDrawn: () => stage.pictures,
        drawNow: () => stage.draw(),
        colors: () => bodies.views.map((view) => view.color.getHexString()),
        triangles: () => stage.renderer.info.render.triangles,
        xOfTime: (time) => page.plots.xOf(time),
    };
}

initTheme();
try {
    window.pong = interfaceOf(new Page(await load()));
    byId("wait").hidden = true;
} catch (error) {
    const old = typeof DecompressionStream === "undefined";
    byId("wait").textContent = old
        ? "This page needs a browser of 2023 or later (DecompressionStream)."
        : `The run cannot be shown: ${error.message}`;
    throw error;
}
