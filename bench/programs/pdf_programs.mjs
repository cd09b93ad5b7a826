// Programs that draw the first page of PDF files of 96 pixels an inch; jobs as for svg_programs.mjs. Splash has white paper,
// the others none.
import {readFileSync, realpathSync, writeFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {extname} from 'node:path';
import {launch} from './chromium.mjs';
import {run} from './run.mjs';

const PIXELS_PER_INCH = 96;

const PAGE = `<!doctype html><canvas></canvas><script type=module>
import * as pdfjs from '/node_modules/pdfjs-dist/legacy/build/pdf.mjs';
pdfjs.GlobalWorkerOptions.workerSrc = '/node_modules/pdfjs-dist/legacy/build/pdf.worker.mjs';
window.draw = async (file, width, height) => {
  const page = await (await pdfjs.getDocument(file).promise).getPage(1), viewport = page.getViewport({scale: 1});
  const canvas = document.querySelector('canvas');
  Object.assign(canvas, {width, height});
  await page.render({canvasContext: canvas.getContext('2d'), canvas, viewport, background: 'rgba(0,0,0,0)',
    transform: [width / viewport.width, 0, 0, height / viewport.height, 0, 0]}).promise;
  return canvas.toDataURL('image/png').split(',')[1];
}</script>`;

const TYPES = {'.mjs': 'text/javascript', '.wasm': 'application/wasm'};

// Serves the page, what stands in node_modules here, and any file as /file/PATH.
function serve() {
  const server = createServer((request, response) => {
    const path = decodeURIComponent(request.url.split('?')[0]);
    try {
      const [type, body] = path === '/' ? ['text/html', PAGE]
        : [TYPES[extname(path)] ?? 'application/octet-stream',
          readFileSync(path.startsWith('/file/') ? path.slice(5) : new URL('.' + path, import.meta.url))];
      response.setHeader('Content-Type', type);
      response.end(body);
    } catch {
      response.statusCode = 404;
      response.end();
    }
  });
  return new Promise(listening => server.listen(0, '127.0.0.1', () => listening(server)));
}

async function openPdfjs() {
  const server = await serve(), browser = await launch(), page = await browser.newPage();
  page.setDefaultTimeout(300_000);
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await page.waitForFunction('window.draw');
  return {
    async draw({file, picture, width, height}) {
      const png = await page.evaluate(([f, w, h]) => draw(f, w, h), ['/file' + realpathSync(file), width, height]);
      writeFileSync(picture, Buffer.from(png, 'base64'));
    },
    async close() {
      await browser.close();
      server.close();
    },
  };
}

const openPoppler = (command, options) => () => ({
  draw: ({file, picture, width, height}) => run(command, ['-png', '-singlefile', '-scale-to-x', width, '-scale-to-y', height, ...options,
    file, picture.replace(/\.png$/, '')]),
});

const openMupdf = () => ({
  draw: ({file, picture, width, height}) => run('mutool', ['draw', '-q', '-w', width, '-h', height, '-f', '-c', 'rgba', '-A', 8,
    '-o', picture, file, 1]),
});

const openGhostscript = () => ({
  draw: ({file, picture, width, height, scale}) => run('gs', ['-q', '-dNOPAUSE', '-dBATCH', '-dSAFER', '-sDEVICE=pngalpha',
    '-dGraphicsAlphaBits=4', '-dFirstPage=1', '-dLastPage=1', `-g${width}x${height}`, `-r${PIXELS_PER_INCH * scale}`,
    `-sOutputFile=${picture}`, file]),
});

export const pdfPrograms = {
  splash: openPoppler('pdftoppm', []),
  cairo: openPoppler('pdftocairo', ['-transp']),
  mupdf: openMupdf,
  ghostscript: openGhostscript,
  pdfjs: openPdfjs,
};
