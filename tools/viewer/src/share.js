// share.js - a link to what is open, and to how it is seen.

// `place` is where it came from, as the page's own address names it: { demo: 1 }, { url }, { ws }; of what was dropped
// nobody else has the bytes, and the link opens nothing
export function linkOf(href, place, step, camera) {
    const wish = new URLSearchParams(place ?? { demo: 'none' });
    wish.set('step', step), wish.set('camera', camera.map((v) => v.toFixed(3)).join('_'));
    return `${href.split(/[?#]/)[0]}?${wish}`;
}
// What an address asks for. A step that is no number is none
export function wishOf(search, hash) {
    const wish = new URLSearchParams(search.slice(1) || hash.slice(1)), step = Number(wish.get('step') ?? NaN);
    return {
        step: Number.isFinite(step) ? step : undefined, camera: wish.get('camera') ?? '',
        url: wish.get('url'), ws: wish.get('ws'), demo: wish.get('demo') ?? '0',
    };
}
