// load.js - where recordings come from: dropped, opened, ?url=, ?ws=. All of them come as pieces to one function.
const $ = (id) => document.getElementById(id);

export function listen(app) {
    let inside = 0;
    const hide = () => (inside = 0, $('drop').hidden = true);
    addEventListener('dragenter', (e) => { e.preventDefault(), ++inside, $('drop').hidden = false; });
    addEventListener('dragover', (e) => e.preventDefault());
    addEventListener('dragleave', () => --inside <= 0 && hide());
    addEventListener('drop', (e) => {
        e.preventDefault(), hide();
        const [a, b] = e.dataTransfer.files;
        if (a) openFile(app, a, b);
    });
    $('open').onclick = () => choose((file) => openFile(app, file));
    addEventListener('paste', (e) => e.clipboardData.files[0] && openFile(app, e.clipboardData.files[0]));
}
export function choose(then) {
    const input = $('file');
    input.value = '', input.onchange = () => input.files[0] && then(input.files[0]);
    input.click();
}
export async function openFile(app, file, second) {
    await app.open(file.name, file.stream(), file.size);
    if (second) await app.compare(second.name, await second.arrayBuffer());
}
export async function openUrl(app, url) {
    try {
        const name = decodeURIComponent(new URL(url, location.href).pathname.split('/').pop());
        const response = await fetch(url);
        if (!response.ok) throw new Error(`the server says ${response.status} ${response.statusText}`);
        await app.open(name, response.body, Number(response.headers.get('content-length')) || 0, { url });
    } catch (error) {
        app.say(`${url} cannot be read: ${error.message}`, 'bad');
    }
}
// The chunks of a file that grows, from feather-live
export function openSocket(app, url) {
    let socket;
    try {
        socket = new WebSocket(url);
    } catch (error) {
        return app.say(`${url} cannot be opened: ${error.message}`, 'bad');
    }
    const source = app.begin(`live: ${url}`, { place: { ws: url }, isLive: true, stop: () => socket.close() });
    socket.binaryType = 'arraybuffer';
    let queue = Promise.resolve();
    const ended = () => {
        if (!source.isOpen) return;
        source.end();
        app.say(source.bytes ? `${url} has ended` : `${url} does not answer`, source.bytes ? 'warm' : 'bad');
    };
    socket.onmessage = ({ data }) => (queue = queue.then(() => source.push(new Uint8Array(data))));
    socket.onclose = () => (queue = queue.then(ended));
    return undefined;
}
