import {spawnSync} from 'node:child_process';

// Runs a program and throws what it said when it fails.
export function run(command, argv) {
  const done = spawnSync(command, argv.map(String), {timeout: 300_000});
  if (done.status !== 0) throw new Error(`${command}: ${done.error ?? String(done.stderr).slice(0, 300)}`);
}
