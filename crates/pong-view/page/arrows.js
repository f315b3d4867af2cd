// Marks at contacts and arrows for their forces. Marks and shafts keep their size on the screen; the length of an
// arrow is the force.

import {
    BufferAttribute, BufferGeometry, ConeGeometry, CylinderGeometry, DynamicDrawUsage, Group, InstancedMesh, Matrix4,
    MeshBasicMaterial, Points, PointsMaterial, Quaternion, Vector3,
} from "three";
import { dotTexture } from "#view/meshes.js";
import { Patches } from "#view/patches.js";
import { HIGHLIGHT, SLIP, STICK, styleColor } from "#view/theme.js";

const MARK_PIXELS = 11, HALO_PIXELS = 24, SHAFT_PIXELS = 3, HEAD_PIXELS = 13;
const UP = new Vector3(0, 1, 0);

/** Arrows of one colour: seen through bodies, but paler there. */
class Arrows extends Group {
    constructor(color) {
        super();
        const shaft = new CylinderGeometry(0.5, 0.5, 1, 10).translate(0, 0.5, 0);
        const head = new ConeGeometry(0.5, 1, 16).translate(0, -0.5, 0);
        const hidden = { color, transparent: true, opacity: 0.4, depthTest: false, depthWrite: false };
        this.materials = [new MeshBasicMaterial(hidden), new MeshBasicMaterial({ color, transparent: true })];
        this.meshes = [];
        this.capacity = 0;
        this.geometries = [shaft, head];
        this.arrows = [];
        this.spare = { matrix: new Matrix4(), turn: new Quaternion(), size: new Vector3(), tip: new Vector3() };
    }

    setColor(color) {
        this.materials.forEach((material) => material.color.set(color));
    }

    /** Sets the start points and vectors of the arrows, m. */
    set(arrows) {
        this.arrows = arrows;
        if (arrows.length > this.capacity) this.#grow(arrows.length);
    }

    #grow(count) {
        this.meshes.forEach((layer) => layer.dispose());
        this.clear();
        this.capacity = Math.max(16, 2 * count);
        this.meshes = this.materials.flatMap((material, depth) =>
            this.geometries.map((geometry) => {
                const layer = new InstancedMesh(geometry, material, this.capacity);
                layer.instanceMatrix.setUsage(DynamicDrawUsage);
                layer.frustumCulled = false;
                layer.renderOrder = 10 + depth;
                return layer;
            }),
        );
        this.add(...this.meshes);
    }

    /** Sizes the arrows for the camera. */
    fit(camera, pixel) {
        const { matrix, turn, size, tip } = this.spare;
        this.arrows.forEach(({ from, direction, length }, index) => {
            const distance = camera.position.distanceTo(from);
            const headLength = Math.min(HEAD_PIXELS * pixel * distance, 0.6 * length);
            const width = SHAFT_PIXELS * pixel * distance;
            turn.setFromUnitVectors(UP, direction);
            matrix.compose(from, turn, size.set(width, length - headLength, width));
            this.#put(0, index, matrix);
            tip.copy(from).addScaledVector(direction, length);
            matrix.compose(tip, turn, size.set(0.7 * headLength, headLength, 0.7 * headLength));
            this.#put(1, index, matrix);
        });
        for (const layer of this.meshes) {
            layer.count = this.arrows.length;
            layer.instanceMatrix.needsUpdate = true;
        }
    }

    #put(part, index, matrix) {
        this.meshes[part].setMatrixAt(index, matrix);
        this.meshes[part + 2].setMatrixAt(index, matrix);
    }
}

/** Dots of one kind. */
class Marks extends Points {
    constructor(color, size, isRing) {
        const material = {
            color, size, sizeAttenuation: false, map: dotTexture(isRing), transparent: true, depthTest: false,
        };
        super(new BufferGeometry(), new PointsMaterial(material));
        this.frustumCulled = false;
        this.renderOrder = 20;
        this.set([]);
    }

    set(places) {
        const { position } = this.geometry.attributes;
        if (!position || position.count < places.length) {
            const room = new BufferAttribute(new Float32Array(3 * Math.max(16, 2 * places.length)), 3);
            this.geometry.setAttribute("position", room.setUsage(DynamicDrawUsage));
        }
        const { array } = this.geometry.attributes.position;
        places.forEach((place, index) => array.set(place, 3 * index));
        this.geometry.attributes.position.needsUpdate = true;
        this.geometry.setDrawRange(0, places.length);
        this.visible = places.length > 0;
    }
}

/** 1 if the force on A is shown, -1 for the one on B. */
export const signFor = ({ a, b }, body) => (b.body === body && a.body !== body ? -1 : 1);

/** Drawn objects of the contacts of a frame. */
export class ContactMarks extends Group {
    constructor() {
        super();
        this.normals = new Arrows("#fff");
        this.sticking = new Arrows(STICK);
        this.slipping = new Arrows(SLIP);
        this.stick = new Marks(STICK, MARK_PIXELS, false);
        this.slip = new Marks(SLIP, MARK_PIXELS, true);
        this.halo = new Marks(HIGHLIGHT, HALO_PIXELS, true);
        this.patches = new Patches();
        this.add(this.patches, this.normals, this.sticking, this.slipping, this.stick, this.slip, this.halo);
        this.recolor();
    }

    recolor() {
        this.normals.setColor(styleColor("--normal-force"));
    }

    /** `metresPerNewton` is the scale; forces are those on `body` where it is B, else those on A. */
    show(contacts, patches, metresPerNewton, body, selected, { hasNormals, hasFriction, pressure }) {
        const arrow = (contact, vector, force) => {
            const direction = new Vector3().fromArray(vector).multiplyScalar(signFor(contact, body));
            return { from: new Vector3().fromArray(contact.point), direction: direction.normalize(), length: force * metresPerNewton };
        };
        const isSeen = ({ length }) => length > 0;
        const frictions = (sticks) =>
            hasFriction
                ? contacts
                      .filter((contact) => contact.sticks === sticks)
                      .map((contact) => arrow(contact, contact.friction, contact.frictionForce))
                      .filter(isSeen)
                : [];
        // The cells of a patch have one arrow and no dot: friction, which sticks or slips, is at contacts of its own.
        const others = contacts.filter((contact) => !contact.isCell);
        const pushing = [...others, ...patches];
        const normals = hasNormals ? pushing.map((c) => arrow(c, c.normal, c.normalForce)).filter(isSeen) : [];
        this.normals.set(normals);
        this.patches.visible = pressure > 0;
        this.patches.show(patches, pressure);
        this.sticking.set(frictions(true));
        this.slipping.set(frictions(false));
        const places = (list) => list.map((contact) => contact.point);
        this.stick.set(places(others.filter((contact) => contact.sticks)));
        this.slip.set(places(others.filter((contact) => !contact.sticks)));
        this.halo.set(places(contacts.filter((contact) => contact.key === selected)));
    }

    get arrowCount() {
        return this.normals.arrows.length + this.sticking.arrows.length + this.slipping.arrows.length;
    }

    fit(camera, pixel) {
        for (const arrows of [this.normals, this.sticking, this.slipping]) arrows.fit(camera, pixel);
    }
}
