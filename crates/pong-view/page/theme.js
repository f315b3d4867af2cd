// Colours. Bodies are muted, so that forces and contacts stand out; stick and slip differ in shape as well as colour.

import { Color } from "three";

const OBJECTS = ["#7d9cc6", "#c9b27a", "#a58fca", "#86b487", "#c99393", "#7fb3bf", "#b9a28b", "#98a1b3"];

/** Steps of lightness, and how far the hues of the bodies of one object may lie apart. */
const SHADES = [0, -0.12, 0.1, -0.05, 0.15], HUES = 0.16;
const GOLDEN = 0.618034;

export const STICK = "#1fb6a3";
export const SLIP = "#f4622e";
export const HIGHLIGHT = "#ffd23f";
export const AXES = ["#e5484d", "#3fa45b", "#4a86e8"];

/** Colour of an object. */
export const objectColor = (object) => OBJECTS[object % OBJECTS.length];

/** Colour of each body: that of its object, those below the root off it in hue and lightness, each by a step of its own. */
export function bodyColors(bodies) {
    const below = new Map();
    return bodies.map(({ object, parent }) => {
        const index = parent === null ? 0 : (below.get(object) ?? 0) + 1;
        if (index) below.set(object, index);
        const hue = index ? HUES * (((index * GOLDEN) % 1) - 0.5) : 0;
        return `#${new Color(objectColor(object)).offsetHSL(hue, 0, SHADES[index % SHADES.length]).getHexString()}`;
    });
}

/** A colour of the style sheet. */
export const styleColor = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export const isDark = () => document.documentElement.dataset.theme !== "light";

/** Dark or light, as the system has it until the reader says otherwise. */
export function initTheme() {
    const wantsLight = matchMedia("(prefers-color-scheme: light)").matches;
    document.documentElement.dataset.theme = wantsLight ? "light" : "dark";
}

export function toggleTheme() {
    document.documentElement.dataset.theme = isDark() ? "light" : "dark";
    document.dispatchEvent(new Event("theme"));
}
