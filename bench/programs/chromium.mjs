// Chromium of the system, with a fresh profile.
import {spawnSync} from 'node:child_process';
import {chromium} from 'playwright-core';

const which = name => String(spawnSync('which', [name]).stdout).trim();

export const launch = () => chromium.launch({
  executablePath: process.env.CHROMIUM || which('chromium'),
  args: ['--no-sandbox', '--disable-gpu', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync', '--force-color-profile=srgb'],
});
