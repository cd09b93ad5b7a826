// Programs that draw SVG files on nothing. Each opens to {draw(job)} with, where it needs them, prepare(job) that opens what
// is open before a user's file, and close(). A job is {file, picture, width, height, scale}: the file is drawn at that scale
// to the PNG picture of width x height pixels.
import {readFileSync, writeFileSync} from 'node:fs';
import {launch} from './chromium.mjs';
import {run} from './run.mjs';

const EMPTY = 'data:image/svg+xml,<svg xmlns="http://www.w3.org/2000/svg"/>';

async function openChromium() {
  const browser = await launch();
  let page;
  const show = async (url, picture) => {
    await page.goto(url, {waitUntil: 'load'});
    await page.screenshot({path: picture, omitBackground: true});
  };
  return {
    async prepare({picture, width, height, scale}) {
      await page?.close();
      page = await browser.newPage({
        viewport: {width: Math.ceil(width / scale), height: Math.ceil(height / scale)}, deviceScaleFactor: scale,
      });
      await show(EMPTY, picture);
    },
    draw: ({file, picture}) => show('file://' + file, picture),
    close: () => browser.close(),
  };
}

async function openResvg() {
  const {Resvg} = await import('@resvg/resvg-js');
  return {
    draw({file, picture, width}) {
      const drawing = new Resvg(readFileSync(file), {fitTo: {mode: 'width', value: width}, font: {loadSystemFonts: false}});
      writeFileSync(picture, drawing.render().asPng());
    },
  };
}

const openLibrsvg = () => ({
  draw: ({file, picture, width, height}) => run('rsvg-convert', ['--unlimited', '-w', width, '-h', height, '-o', picture, file]),
});

const openInkscape = () => ({
  draw: ({file, picture, width, height}) => run('inkscape', ['--export-type=png', '-w', width, '-h', height, '--export-area-page',
    '--export-background-opacity=0', '-o', picture, file]),
});

export const svgPrograms = {chromium: openChromium, resvg: openResvg, librsvg: openLibrsvg, inkscape: openInkscape};
