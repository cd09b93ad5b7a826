// draw.mjs PROGRAM JOBS.json RESULTS.json: lets a program draw files, one job after another (see svg_programs.mjs). A job's
// result is {cpu, seconds}, CPU and wall time of the drawing and its PNG, or {error}.
import {readFileSync, writeFileSync} from 'node:fs';
import {cpuSeconds} from './cpu_seconds.mjs';
import {pdfPrograms} from './pdf_programs.mjs';
import {svgPrograms} from './svg_programs.mjs';

const [name, jobs, results] = process.argv.slice(2);
const program = await {...svgPrograms, ...pdfPrograms}[name]();

async function timed(job) {
  try {
    await program.prepare?.(job);
    const cpu = cpuSeconds(), start = performance.now();
    await program.draw(job);
    return {cpu: cpuSeconds() - cpu, seconds: (performance.now() - start) / 1000};
  } catch (error) {
    return {error: String(error.message ?? error).slice(0, 300)};
  }
}

const all = [];
for (const job of JSON.parse(readFileSync(jobs))) all.push(await timed(job));
await program.close?.();
writeFileSync(results, JSON.stringify(all));
