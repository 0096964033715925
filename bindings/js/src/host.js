// host.js - what the module asks of its host: a clock, and numbers as text. `bytes` gives the module's memory as it is
// now, as a Uint8Array.

// printf's %.*g and %.*f: error sentences are the same in every language
function format(value, digits, fixed) {
    if (!Number.isFinite(value)) return value !== value ? 'nan' : value < 0 ? '-inf' : 'inf';
    if (fixed) return value.toFixed(digits);
    const [mantissa, power] = value.toExponential(Math.max(digits, 1) - 1).split('e');
    const short = (s) => (s.includes('.') ? s.replace(/\.?0+$/, '') : s);
    const e = Number(power), sign = Object.is(value, -0) ? '-' : '';
    if (e >= -4 && e < digits) return sign + short(value.toFixed(digits - 1 - e < 100 ? digits - 1 - e : 100));
    return sign + short(mantissa) + 'e' + (e < 0 ? '-' : '+') + String(Math.abs(e)).padStart(2, '0');
}

const decoder = new TextDecoder();
// Text that a 0 ends. A copy is decoded: browsers refuse shared memory.
export function textOf(bytes, at) {
    let end = at;
    while (bytes[end]) ++end;
    return decoder.decode(bytes.slice(at, end));
}

export const host = (bytes) => ({
    clock: () => performance.now(),
    read: (at) => Number(textOf(bytes(), at)),
    write: (value, digits, fixed, out) => {
        const s = format(value, digits, fixed).slice(0, 31), view = bytes();
        for (let i = 0; i < s.length; ++i) view[out + i] = s.charCodeAt(i);
        return s.length;
    },
});
