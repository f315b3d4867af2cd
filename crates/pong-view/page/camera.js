// Where the picture is taken from: orbit, pan, zoom; along with a body; standard views.

import { Box3, OrbitControls, Quaternion, Vector3 } from "three";

/** Views by name: direction from the target to the camera. */
const VIEWS = { oblique: [1, -1.4, 1.1], front: [0, -1, 0], right: [1, 0, 0], top: [0, -1e-4, 1], left: [-1, 0, 0], back: [0, 1, 0] };
/** Share of the picture, in width and height, that the target may fill; bars cover its upper and lower edge. */
const FILL = [0.9, 0.76];
/** Factor of the distance for one press of a zoom key. */
const KEY_ZOOM = 1.2;

export class CameraControl {
    constructor(stage, bodies) {
        this.stage = stage;
        this.bodies = bodies;
        this.controls = new OrbitControls(stage.camera, stage.canvas);
        this.controls.addEventListener("change", () => stage.redraw());
        this.controls.zoomToCursor = true;
        this.controls.enableDamping = false;
        this.mode = "free";
        this.body = 0;
        this.last = { place: new Vector3(), turn: new Quaternion() };
    }

    /** `free`, `follow` a body's place, or `ride` on it, turning as well. */
    setMode(mode, body = this.body) {
        this.mode = mode;
        this.body = body;
        this.#remember();
    }

    #remember() {
        const view = this.bodies.views[this.body];
        this.last.place.copy(view.position);
        this.last.turn.copy(view.quaternion);
    }

    /** Moves along with the body, after the bodies have been put in place. */
    update() {
        const view = this.bodies.views[this.body];
        const { camera } = this.stage, { target } = this.controls;
        if (this.mode !== "free" && view.visible) {
            if (this.mode === "ride") {
                const turn = view.quaternion.clone().multiply(this.last.turn.clone().invert());
                for (const place of [camera.position, target]) {
                    place.sub(this.last.place).applyQuaternion(turn).add(this.last.place);
                }
                camera.up.applyQuaternion(turn);
            }
            const way = view.position.clone().sub(this.last.place);
            camera.position.add(way);
            target.add(way);
            camera.lookAt(target);
        }
        this.#remember();
    }

    /** Looks at points from a standard direction, or from the present one. */
    frame(places, side) {
        if (!places.length) places = [new Vector3(-0.5, -0.5, -0.5), new Vector3(0.5, 0.5, 0.5)];
        const { camera } = this.stage;
        const direction = side
            ? new Vector3().fromArray(VIEWS[side])
            : camera.position.clone().sub(this.controls.target);
        if (side) camera.up.set(0, 0, 1);
        direction.normalize();
        const { target, distance } = this.#aim(places, direction);
        camera.position.copy(target).addScaledVector(direction, distance);
        this.controls.target.copy(target);
        camera.lookAt(target);
        this.controls.update();
        this.stage.redraw();
    }

    // Target along a direction, and distance, for which all points fill the picture.
    #aim(places, direction) {
        const { camera } = this.stage;
        const across = new Vector3().crossVectors(camera.up, direction).normalize();
        const up = new Vector3().crossVectors(direction, across);
        const slope = Math.tan((camera.fov * Math.PI) / 360);
        const slopes = [FILL[0] * slope * camera.aspect, FILL[1] * slope];
        const target = new Box3().setFromPoints(places).getCenter(new Vector3());
        let distance = 1;
        // The centre of the picture is not the centre of the points, because near things look larger.
        for (let round = 0; round < 4; round++) {
            const seen = places.map((place) => {
                const from = place.clone().sub(target);
                return [across, up, direction].map((axis) => from.dot(axis));
            });
            distance = seen.reduce((far, [x, y, z]) => Math.max(far, z + Math.abs(x) / slopes[0], z + Math.abs(y) / slopes[1]), 0) || 1;
            [across, up].forEach((axis, index) => {
                const [low, high] = bounds(seen.map((place) => place[index] / Math.max(distance - place[2], 1e-9 * distance)));
                target.addScaledVector(axis, (distance * (low + high)) / 2);
            });
        }
        return { target, distance };
    }

    /** Looks at a point from a distance. */
    lookAt(place, distance) {
        const { camera } = this.stage;
        const direction = camera.position.clone().sub(this.controls.target).normalize();
        this.controls.target.copy(place);
        camera.position.copy(place).addScaledVector(direction, distance);
        this.controls.update();
        this.stage.redraw();
    }

    zoom(steps) {
        const { camera } = this.stage, { target } = this.controls;
        camera.position.sub(target).multiplyScalar(KEY_ZOOM ** -steps).add(target);
        this.stage.redraw();
    }

    get distance() {
        return this.stage.camera.position.distanceTo(this.controls.target);
    }
}

const bounds = (numbers) => numbers.reduce(([low, high], x) => [Math.min(low, x), Math.max(high, x)], [Infinity, -Infinity]);
