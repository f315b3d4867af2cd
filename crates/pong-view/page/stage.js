// The picture: renderer, lights, and drawing only when something has changed.

import { AmbientLight, Color, DirectionalLight, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { styleColor } from "#view/theme.js";

const FIELD_OF_VIEW = 40;
/** Triangles are drawn beyond this share of the distance looked at; behind, precision is spent on what is near. */
const NEAR = 1 / 400, FAR = 4000;

export class Stage {
    constructor(canvas) {
        this.canvas = canvas;
        this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "high-performance" });
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.scene = new Scene();
        this.camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 1000);
        this.camera.up.set(0, 0, 1);
        this.scene.add(this.camera, new AmbientLight(0xffffff, 1.1));
        for (const [x, y, z, strength] of [[0.4, 0.7, 1, 1.9], [-0.8, -0.3, 0.4, 0.5]]) {
            const light = new DirectionalLight(0xffffff, strength);
            light.position.set(x, y, z);
            this.camera.add(light, light.target);
            light.target.position.set(0, 0, -0.001);
        }
        /** Called with the seconds since the last one before a frame that moves, and before every picture. */
        this.onTick = () => false;
        this.onDraw = () => {};
        this.pictures = 0;
        this.isStale = true;
        this.recolor();
        new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
        this.resize();
    }

    recolor() {
        this.scene.background = new Color(styleColor("--view"));
        this.redraw();
    }

    resize() {
        const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
        if (width < 1 || height < 1) return;
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / height;
        this.camera.updateProjectionMatrix();
        this.redraw();
    }

    redraw() {
        this.isStale = true;
    }

    /** Size of a pixel at a distance of one metre, m. */
    get pixel() {
        return (2 * Math.tan((FIELD_OF_VIEW * Math.PI) / 360)) / this.canvas.clientHeight;
    }

    setDepth(distance) {
        this.camera.near = distance * NEAR;
        this.camera.far = distance * FAR;
        this.camera.updateProjectionMatrix();
    }

    draw() {
        this.isStale = false;
        this.onDraw();
        this.renderer.render(this.scene, this.camera);
        this.pictures++;
    }

    /** Starts the loop. */
    run() {
        let before = performance.now();
        const tick = (now) => {
            const moved = this.onTick(Math.min((now - before) / 1000, 0.25));
            before = now;
            if (moved || this.isStale) this.draw();
            requestAnimationFrame(tick);
        };
        requestAnimationFrame(tick);
    }

    /** The picture as a PNG file. */
    save(name) {
        this.draw();
        this.canvas.toBlob((blob) => {
            const link = document.createElement("a");
            link.href = URL.createObjectURL(blob);
            link.download = name;
            link.click();
            setTimeout(() => URL.revokeObjectURL(link.href), 1000);
        });
    }
}
