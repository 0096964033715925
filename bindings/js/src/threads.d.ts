import { FeatherModule } from './index.js';
export * from './index.js';

/** How many threads there are to be. */
export interface ThreadsOptions {
    /** Threads that step together, the calling one among them: 1..64. Default: the machine's cores, at most 8. */
    threads?: number;
}
/** The module, and what runs it. */
export interface Threads extends FeatherModule {
    /** Threads that run; 1 where the host gives none. */
    readonly threads: number;
    /** Why there are fewer than was asked for. */
    readonly reason: string | undefined;
}
/** Starts the module and its threads, once: a second call gives what the first one started. */
export default function Feather(options?: ThreadsOptions): Promise<Threads>;
