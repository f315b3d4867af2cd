// The tables of a log, read without any code of ours: what the page shows is compared with this.

import { readFileSync } from "node:fs";

const READERS = {
    "<f8": [8, (view, at) => view.getFloat64(at, true)],
    "<u8": [8, (view, at) => Number(view.getBigUint64(at, true))],
    "<u4": [4, (view, at) => view.getUint32(at, true)],
};

/** Rows of a structured table, each an object of numbers and arrays of numbers. */
export function readTable(file) {
    const bytes = readFileSync(file);
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    const headerLength = view.getUint16(8, true);
    const header = bytes.toString("latin1", 10, 10 + headerLength);
    const fields = [...header.matchAll(/\('(\w+)', '(<\w\d)'(?:, \((\d+),\))?\)/g)].map(([, name, type, count]) => ({
        name, reader: READERS[type], count: count === undefined ? 0 : Number(count),
    }));
    const shape = header.match(/'shape': \(([^)]*)\)/)[1].split(",").filter((part) => part.trim()).map(Number);
    let at = 10 + headerLength;
    const number = ([size, read]) => {
        const value = read(view, at);
        at += size;
        return value;
    };
    const field = ({ name, reader, count }) =>
        [name, count ? Array.from({ length: count }, () => number(reader)) : number(reader)];
    const rows = shape.reduce((product, size) => product * size, 1);
    return Array.from({ length: rows }, () => Object.fromEntries(fields.map(field)));
}
