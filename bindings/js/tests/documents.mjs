// The blocks of JavaScript in a document: each goes on from the one before, and one that imports Feather begins a program
// of its own. What a comment `// prints: text` promises is printed.   node documents.mjs document.md...
import { readFileSync, writeFileSync, mkdtempSync, rmSync } from 'node:fs';
import { execFileSync } from 'node:child_process';
import { tmpdir } from 'node:os';
import { file } from './package.mjs';

let blocks = 0;
for (const name of process.argv.slice(2)) {
    const text = readFileSync(name, 'utf8'), programs = [];
    for (const [, block] of text.matchAll(/^```js\n([\s\S]*?)^```$/gm)) {
        ++blocks;
        if (!programs.length || /^import Feather /m.test(block)) programs.push([]);
        programs.at(-1).push(block);
    }
    for (const program of programs) run(name, program.join('\n'));
    if (!name.endsWith('javascript.md')) continue;
    const first = programs[0][0].trim(), lines = first.split('\n').filter((l) => l.trim()).length;
    if (lines > 8 || first.length > 400) throw new Error(`the first program has ${lines} lines and ${first.length} characters; 8 and 400 are the most`);
}
if (!blocks) throw new Error('no block of JavaScript');

function run(name, program) {
    const folder = mkdtempSync(`${tmpdir()}/feather-`), script = `${folder}/document.mjs`;
    writeFileSync(script, program.replaceAll(/'feather-physics(\/\w+)?'/g, (_, part) => `'${file((part ?? '/index') .slice(1) + '.js').href}'`));
    const told = execFileSync(process.execPath, [script], { encoding: 'utf8' }).trim().split('\n');
    rmSync(folder, { recursive: true });
    const promised = [...program.matchAll(/\/\/ prints: (.*)$/gm)].map((m) => m[1]);
    if (promised.join('\n') !== told.join('\n')) throw new Error(`${name} promises\n${promised.join('\n')}\nand prints\n${told.join('\n')}`);
}
