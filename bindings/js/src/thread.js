// thread.js - a worker of feather-physics/threads: an instance of the module on the memory it is sent. It waits at its
// seat for tasks (os_thread_wasm.c), and hears no second message.
import { host } from './host.js';

function serve({ module, memory, seat }, answer) {
    const bytes = () => new Uint8Array(memory.buffer);
    const { exports: x } = new WebAssembly.Instance(module, { env: { memory }, host: host(bytes) });
    const [stackTop, storage] = new Uint32Array(memory.buffer, seat, 2);
    x.__stack_pointer.value = stackTop;
    x.__wasm_init_tls(storage);
    x.thread_arrive(seat);
    answer('ready');
    x.thread_serve(seat);
}

if (typeof WorkerGlobalScope === 'undefined') {
    const threads = 'node:worker_threads'; // by a name that no bundler follows: it is node's alone
    import(/* webpackIgnore: true */ /* @vite-ignore */ threads)
        .then(({ parentPort }) => parentPort.once('message', (seat) => serve(seat, (text) => parentPort.postMessage(text))));
} else {
    addEventListener('message', ({ data }) => serve(data, postMessage), { once: true });
}
