// Where the picture is taken from: orbit, pan, zoom; along with a body; standard views.

import { OrbitControls, Quaternion, Vector3 } from "three";

/** Views by name: where the camera stands from what it looks at. */
const VIEWS = { oblique: [1, -1.4, 1.1], front: [0, -1, 0], right: [1, 0, 0], top: [0, -1e-4, 1], left: [-1, 0, 0], back: [0, 1, 0] };
const MARGIN = 1.02;
/** Of the shown distance, for the keys that turn and zoom. */
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

    /** Looks at a box from a standard side, or from where it is. */
    frame(box, side) {
        if (box.isEmpty()) return;
        const { camera } = this.stage;
        const center = box.getCenter(new Vector3());
        const direction = side
            ? new Vector3().fromArray(VIEWS[side])
            : camera.position.clone().sub(this.controls.target);
        if (side) camera.up.set(0, 0, 1);
        direction.normalize();
        const radius = 0.5 * box.getSize(new Vector3()).length() || 0.5;
        const half = (camera.fov * Math.PI) / 360;
        const narrow = Math.min(half, Math.atan(Math.tan(half) * camera.aspect));
        camera.position.copy(center).addScaledVector(direction, (MARGIN * radius) / Math.sin(narrow));
        this.controls.target.copy(center);
        camera.lookAt(center);
        this.controls.update();
        this.stage.redraw();
    }

    /** Looks at a place from so far away. */
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
