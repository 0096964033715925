// inflate.js - bytes out of deflated ones (RFC 1951), for scripts that hold the module: hosts have none that is done at
// once, and those that they have come later.

const LENGTHS = [3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 15, 17, 19, 23, 27, 31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258];
const LENGTH_BITS = [0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0];
const DISTANCES = [1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577];
const ORDER = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];
const MOST = 15; // bits of a code

// A table of all that MOST bits may be: symbol << 4 | bits of its code. Codes come with their first bit lowest
function table(lengths) {
    const of = new Uint16Array(1 << MOST);
    let code = 0;
    for (let bits = 1; bits <= MOST; ++bits, code <<= 1) {
        for (let symbol = 0; symbol < lengths.length; ++symbol) {
            if (lengths[symbol] !== bits) continue;
            let first = 0;
            for (let k = 0; k < bits; ++k) first |= ((code >> k) & 1) << (bits - 1 - k);
            for (; first < 1 << MOST; first += 1 << bits) of[first] = (symbol << 4) | bits;
            ++code;
        }
    }
    return of;
}

// `bytes` as zlib's deflateRaw makes them of `size` bytes
export function inflate(bytes, size) {
    const out = new Uint8Array(size);
    let at = 0, to = 0, held = 0, count = 0, last = 0;
    const take = (n) => {
        while (count < n) held |= bytes[at++] << count, count += 8;
        const value = held & ((1 << n) - 1);
        held >>>= n, count -= n;
        return value;
    };
    const symbolOf = (codes) => {
        while (count < MOST) held |= bytes[at++] << count, count += 8; // behind the end undefined, which is 0 here
        const found = codes[held & ((1 << MOST) - 1)];
        held >>>= found & 15, count -= found & 15;
        return found >> 4;
    };
    while (!last) {
        last = take(1);
        const kind = take(2);
        if (kind === 0) {
            at -= count >> 3, held = count = 0;
            const n = bytes[at] | (bytes[at + 1] << 8);
            out.set(bytes.subarray(at + 4, at + 4 + n), to);
            at += 4 + n, to += n;
            continue;
        }
        let lengths = Array.from({ length: 288 }, (_, k) => (k < 144 ? 8 : k < 256 ? 9 : k < 280 ? 7 : 8)), most = 288;
        if (kind === 1) lengths = [...lengths, ...Array(30).fill(5)];
        else {
            const distances = (most = take(5) + 257, take(5) + 1), sizes = Array(19).fill(0);
            for (let n = take(4) + 4, k = 0; k < n; ++k) sizes[ORDER[k]] = take(3);
            const codes = table(sizes);
            lengths = [];
            while (lengths.length < most + distances) {
                const symbol = symbolOf(codes);
                const [value, n] = symbol < 16 ? [symbol, 1] : symbol === 16 ? [lengths.at(-1), 3 + take(2)] : symbol === 17 ? [0, 3 + take(3)] : [0, 11 + take(7)];
                for (let k = 0; k < n; ++k) lengths.push(value);
            }
        }
        const literals = table(lengths.slice(0, most)), distances = table(lengths.slice(most));
        for (;;) {
            const symbol = symbolOf(literals);
            if (symbol === 256) break;
            if (symbol < 256) { out[to++] = symbol; continue; }
            const end = to + LENGTHS[symbol - 257] + take(LENGTH_BITS[symbol - 257]), d = symbolOf(distances);
            const back = DISTANCES[d] + take(d < 4 ? 0 : (d >> 1) - 1);
            for (; to < end; ++to) out[to] = out[to - back];
        }
    }
    return out;
}
