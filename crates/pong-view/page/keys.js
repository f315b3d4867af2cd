// The keyboard. The help shows this list.

/** Binds keys; `actions` holds what they do by name. Returns rows for the help: keys and what they do. */
export function bindKeys(actions) {
    const bindings = [
        [[" "], "Space", "play or pause", () => actions.toggle()],
        [["ArrowRight"], "→", "next frame; with Shift ten", (event) => actions.step(event.shiftKey ? 10 : 1)],
        [["ArrowLeft"], "←", "previous frame; with Shift ten", (event) => actions.step(event.shiftKey ? -10 : -1)],
        [["Home"], "Home", "first frame", () => actions.first()],
        [["End"], "End", "last frame", () => actions.last()],
        [["n"], "N", "next change of contacts", () => actions.change(1)],
        [["p"], "P", "previous change of contacts", () => actions.change(-1)],
        [["m"], "M", "frame of the picked body's largest force", () => actions.peak()],
        [["]", "."], "]", "faster", () => actions.speed(1)],
        [["[", ","], "[", "slower", () => actions.speed(-1)],
        [["1"], "1", "real time", () => actions.realTime()],
        [["l"], "L", "play again and again", () => actions.loop()],
        [["a"], "A", "show all bodies", () => actions.frameAll()],
        [["f"], "F", "show the picked body", () => actions.frameBody()],
        [["c"], "C", "camera: free, follow, ride", () => actions.camera()],
        [["v"], "V", "next standard view", () => actions.view()],
        [["+", "="], "+", "zoom in", () => actions.zoom(1)],
        [["-"], "−", "zoom out", () => actions.zoom(-1)],
        [["x"], "X", "see through bodies", () => actions.flip("xray")],
        [["e"], "E", "edges", () => actions.flip("edges")],
        [["h"], "H", "primitives in contact", () => actions.flip("highlight")],
        [["u"], "U", "patches of solids with their pressure", () => actions.flip("patches")],
        [["t"], "T", "dark or light", () => actions.theme()],
        [["s"], "S", "save the picture", () => actions.save()],
        [["Escape"], "Esc", "drop the selected contact", () => actions.drop()],
        [["?"], "?", "this help", () => actions.help()],
    ];
    letGoOfWhatIsClicked();
    const byKey = new Map(bindings.flatMap(([keys, , , action]) => keys.map((key) => [key, action])));
    document.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const { target } = event;
        const types = target.matches?.("select, input:not([type=range]):not([type=checkbox])");
        const presses = event.key === " " && target.matches?.("button, input[type=checkbox], summary");
        if (types || presses || document.querySelector("dialog[open]")) return;
        // The slider of the arrows' scale keeps its own arrow keys.
        if (event.key.startsWith("Arrow") && target.matches?.("input[type=range]:not(#scrubber)")) return;
        const action = byKey.get(event.key.length === 1 ? event.key.toLowerCase() : event.key);
        if (!action) return;
        event.preventDefault();
        action(event);
    });
    return bindings.map(([, shown, meaning]) => [shown, meaning]);
}

/**
 * Lets go of a button or box once a pointer has pressed it: it would keep the focus, and take Space for another press.
 * Who walks by Tab keeps the focus, and presses with Space. Before the click is handled, so that a dialog that it opens
 * gives the focus back to the page.
 */
function letGoOfWhatIsClicked() {
    const pressed = "button, select, summary, input[type=checkbox]";
    let byPointer = false;
    document.addEventListener("pointerdown", () => { byPointer = true; }, true);
    document.addEventListener("keydown", () => { byPointer = false; }, true);
    const letGo = () => {
        const focused = document.activeElement;
        if (byPointer && focused?.matches(pressed) && !focused.closest("dialog")) focused.blur();
    };
    document.addEventListener("click", (event) => { if (!event.target.closest("select")) letGo(); }, true);
    document.addEventListener("change", letGo);
}
