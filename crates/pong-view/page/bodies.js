// The bodies of a run where they are at a moment.

import {
    Box3, BufferAttribute, BufferGeometry, Color, DoubleSide, Group, InstancedMesh, LineBasicMaterial, LineMaterial,
    LineSegments, LineSegments2, Mesh, MeshBasicMaterial, MeshLambertMaterial, PlaneGeometry, Points, PointsMaterial,
    Quaternion, Vector3,
} from "three";
import { dotTexture, ShapeMeshes, unitBall } from "#view/meshes.js";
import { bodyColors, isDark } from "#view/theme.js";
import { niceStep } from "#view/units.js";

const POINT_PIXELS = 7, LINE_PIXELS = 3;
const XRAY = 0.3;
/** A still body is shown at the start unless it is larger than the moving ones by this factor. */
const SURROUNDINGS = 4;
/** A path longer than this many times the bodies on it is not shown as a whole at the start. */
const LONG_WAY = 12;
/** Number of frames sampled for the extent of a run. */
const SAMPLES = 200;
/** Stride of the sampled frames whose positions are fitted into the picture. */
const STATIONS = 20;

/** A body and its drawn objects. */
class BodyView extends Group {
    constructor(index, color, meshes, dot) {
        super();
        this.meshes = meshes;
        this.color = new Color(color);
        this.isShown = true;
        this.planes = [];
        this.solids = [];
        this.lineParts = [];
        const lambert = { color: this.color, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
        this.material = new MeshLambertMaterial({ ...lambert, flatShading: true });
        this.smooth = new MeshLambertMaterial(lambert);
        this.lineMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.55 });
        const add = (object, list) => {
            object.userData.body = index;
            list?.push(object);
            this.add(object);
        };
        if (meshes.surface) add(new Mesh(meshes.surface, this.material), this.solids);
        if (meshes.edges) add(new LineSegments(meshes.edges, this.lineMaterial), this.lineParts);
        if (meshes.circles) add(new LineSegments(meshes.circles, this.lineMaterial), this.lineParts);
        if (meshes.ballCount) add(this.#balls(), this.solids);
        const dots = new PointsMaterial({
            color: this.color, size: POINT_PIXELS, sizeAttenuation: false, map: dot, alphaTest: 0.5,
        });
        for (const places of [meshes.points, meshes.tips]) if (places) add(new Points(places, dots));
        if (meshes.lines) add(new LineSegments2(meshes.lines, new LineMaterial({ color: this.color, linewidth: LINE_PIXELS })));
        this.recolor();
    }

    #balls() {
        const balls = new InstancedMesh(unitBall(), this.smooth, this.meshes.ballCount);
        balls.instanceMatrix = this.meshes.sharedBallMatrices();
        return balls;
    }

    recolor() {
        this.lineMaterial.color.copy(this.color).lerp(new Color(isDark() ? "#000" : "#10182a"), 0.7);
    }

    setXray(isOn) {
        for (const material of [this.material, this.smooth]) {
            Object.assign(material, { transparent: isOn, opacity: isOn ? XRAY : 1, depthWrite: !isOn, needsUpdate: true });
        }
    }

    /** Shows the half spaces as squares with a grid around a place near the run, in the body's frame. */
    addPlanes(center, size) {
        const { planes } = this.meshes.shape;
        for (let i = 0; i < planes.length; i += 4) {
            const normal = new Vector3().fromArray(planes, i);
            const plane = new Group();
            plane.position.copy(center).addScaledVector(normal, planes[i + 3] - normal.dot(center));
            plane.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), normal);
            const sheet = { color: this.color, transparent: true, side: DoubleSide, depthWrite: false };
            const square = new Mesh(new PlaneGeometry(size, size), new MeshBasicMaterial({ ...sheet, opacity: 0.18 }));
            square.renderOrder = -1;
            const lines = new LineBasicMaterial({ color: this.color, transparent: true, opacity: 0.35 });
            plane.add(square, new LineSegments(grid(size), lines));
            plane.userData.square = square;
            this.planes.push(plane);
            this.add(plane);
        }
    }
}

function grid(size) {
    const step = niceStep(size, 20), places = [];
    for (let x = 0; x <= size / 2; x += step) {
        for (const at of x === 0 ? [0] : [-x, x]) {
            places.push(at, -size / 2, 0, at, size / 2, 0, -size / 2, at, 0, size / 2, at, 0);
        }
    }
    return new BufferGeometry().setAttribute("position", new BufferAttribute(Float32Array.from(places), 3));
}

const sizeOf = (box) => box.getSize(new Vector3()).length();

/** All bodies. */
export class Bodies extends Group {
    constructor(run) {
        super();
        this.run = run;
        const shapes = run.shapes.map((shape) => new ShapeMeshes(shape));
        const dot = dotTexture(false), colors = bodyColors(run.bodies);
        this.views = run.bodies.map((body, index) => new BodyView(index, colors[index], shapes[body.shape], dot));
        this.add(...this.views);
        this.from = { place: new Vector3(), turn: new Quaternion() };
        this.to = { place: new Vector3(), turn: new Quaternion() };
        this.#measure();
    }

    /** Sets the poses of all bodies at a moment; between frames interpolated linearly, rotations on the shortest arc. */
    show(frame, fraction) {
        this.views.forEach((view, body) => {
            this.#pose(frame, body, this.from);
            const { place, turn } = this.from;
            if (fraction > 0) {
                this.#pose(frame + 1, body, this.to);
                if (!Number.isNaN(this.to.place.x)) {
                    place.lerp(this.to.place, fraction);
                    turn.slerp(this.to.turn, fraction);
                }
            }
            const isKnown = !Number.isNaN(place.x + turn.x);
            view.visible = view.isShown && isKnown;
            if (!isKnown) return;
            view.position.copy(place);
            view.quaternion.copy(turn);
            view.updateMatrixWorld(true);
        });
    }

    #pose(frame, body, pose) {
        const { position, orientation } = this.run.frames;
        const at = frame * this.views.length + body;
        pose.place.fromArray(position, 3 * at);
        const [w, x, y, z] = orientation.subarray(4 * at, 4 * at + 4);
        pose.turn.set(x, y, z, w);
    }

    /** Box around some bodies in their present poses. */
    box(indices = this.views.keys()) {
        const box = new Box3();
        for (const index of indices) {
            const view = this.views[index];
            if (view.visible && !view.meshes.box.isEmpty()) {
                box.union(view.meshes.box.clone().applyMatrix4(view.matrixWorld));
            }
        }
        return box;
    }

    /** The bodies that move at all; all of them if none does. */
    get moving() {
        return this.movers.length ? this.movers : [...this.views.keys()];
    }

    /** Points on the outside of some bodies in their present poses. */
    places(indices = this.views.keys()) {
        return [...indices].flatMap((index) => {
            const view = this.views[index];
            return view.visible ? view.meshes.marks.map((place) => place.clone().applyMatrix4(view.matrixWorld)) : [];
        });
    }

    /** Points to fit into the picture: the moving bodies, with their path unless it is long, and other bodies of their size. */
    get subject() {
        const now = this.box(this.moving), limit = SURROUNDINGS * sizeOf(now);
        const still = [...this.views.keys()].filter((body) => sizeOf(this.box([body])) < limit);
        const places = this.places(new Set([...still, ...this.moving]));
        return this.isWayShort ? [...places, ...this.stations] : places;
    }

    // Extent of the run, moving bodies, and planes of a matching size.
    #measure() {
        const { run } = this, room = new Box3(), start = [];
        const steps = Math.max(1, Math.ceil(run.frameCount / SAMPLES));
        const movers = new Set();
        for (let frame = 0; frame < run.frameCount; frame += steps) {
            this.show(frame, 0);
            room.union(this.box());
            this.views.forEach((view, body) => {
                start[body] ??= view.matrixWorld.clone();
                if (!view.matrixWorld.equals(start[body])) movers.add(body);
            });
        }
        this.movers = [...movers];
        this.way = new Box3();
        this.stations = [];
        for (let frame = 0; frame < run.frameCount; frame += steps) {
            this.show(frame, 0);
            this.way.union(this.box(this.movers));
            if (frame % (steps * STATIONS) === 0) this.stations.push(...this.places(this.movers));
        }
        this.show(0, 0);
        this.isWayShort = sizeOf(this.way) < LONG_WAY * sizeOf(this.box(this.moving));
        if (room.isEmpty()) room.setFromCenterAndSize(new Vector3(), new Vector3(1, 1, 1));
        this.size = room.getSize(new Vector3()).length() || 1;
        const center = room.getCenter(new Vector3());
        for (const view of this.views) view.addPlanes(view.worldToLocal(center.clone()), 2 * this.size);
    }

    setXray(isOn) {
        this.views.forEach((view) => view.setXray(isOn));
    }

    setEdges(areShown) {
        for (const view of this.views) for (const part of view.lineParts) part.visible = areShown;
    }

    recolor() {
        this.views.forEach((view) => view.recolor());
    }
}
