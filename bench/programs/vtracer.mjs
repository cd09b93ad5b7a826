// vtracer.mjs PRESET PICTURE OUT.svg: VTracer's tracing of a picture by one of its presets, Photo or Poster.
import {readFileSync, writeFileSync} from 'node:fs';
import {Preset, vectorize} from '@neplex/vectorizer';

const [preset, picture, out] = process.argv.slice(2);
writeFileSync(out, await vectorize(readFileSync(picture), Preset[preset]));
