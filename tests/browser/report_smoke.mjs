// SPDX-License-Identifier: Apache-2.0
// node report_smoke.mjs PAGE: opens the built report page with a small recording from disk, as a reader
// would, and asks whether it shows what it should. Ends with 77 (skipped) where there is no Chromium.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { findChromium, openBrowser } from './chromium.mjs';

const kFrames = 40;

/// One body that turns; lost in frames 20 to 23, where the filter predicts.
function recording() {
  const frames = Array.from({ length: kFrames }, (_, i) => i);
  const lost = (i) => i >= 20 && i < 24;
  const covariance = [1e-4, 0, 0, 1e-4, 0, 4e-4, 1e-8, 0, 0, 1e-8, 0, 1e-8];
  const motion = (i, off) => [100 * Math.sin(i / 6) + off, 0, 2000, Math.cos(i / 80), 0, Math.sin(i / 80), 0];
  const lens = { fx: 1000, fy: 1000, skew: 0, cx: 639.5, cy: 479.5, distortion: [], width_px: 1280, height_px: 960 };
  const places = [[200, 0, 0], [-200, 50, 0], [0, 210, 40], [30, -190, 20]];
  return {
    schema: 'asterism-tracking-report/1', title: 'A turning body', subtitle: '', remarks: ['lost once'], options: { filter: { coast_s: 0.2 } },
    summary: [{ label: 'Frames', value: '40', unit: '', note: '', verdict: 'good' }],
    rig: { left: lens, right: lens, right_from_left: [-500, 0, 0, 1, 0, 0, 0] },
    frames: { frame: frames, time_s: frames.map((i) => i / 10), centres_left: frames.map(() => 4), centres_right: frames.map(() => 4) },
    bodies: [{
      name: '</script><b>platform</b>', point: { name: 'centroid', position_mm: [0, 0, 0] },
      targets: places.map((position_mm, i) => ({ id: `P${i + 1}`, position_mm, normal: [0, 0, -1], diameter_mm: 12 })),
      status: frames.map((i) => (lost(i) ? 'L' : 'O')).join(''), filtered_status: frames.map((i) => (lost(i) ? 'R' : 'O')).join(''),
      measured: frames.map((i) => (lost(i) ? null : [...motion(i, 0.01), ...covariance])),
      filtered: frames.map((i) => [...motion(i, lost(i) ? 0.5 : 0.005), ...covariance]),
      truth: frames.map((i) => motion(i, 0)), targets_used: frames.map((i) => (lost(i) ? 0 : 4)), rms_px: frames.map((i) => (lost(i) ? null : 0.02)),
      sightings: places.map(() => ({ seen: frames.map((i) => (lost(i) ? '0' : '3')).join(''), left_px: frames.map((i) => (lost(i) ? null : [0.01, 0])), right_px: frames.map((i) => (lost(i) ? null : [0, 0.01])) })),
    }],
  };
}

function pageWith(template, data) {
  const open = 'id="report-data">';
  const begin = template.indexOf(open) + open.length;
  return template.slice(0, begin) + JSON.stringify(data).replace(/</g, '\\u003c') + template.slice(template.indexOf('</script>', begin));
}

const failures = [];
function expect(holds, what) {
  if (!holds) failures.push(what);
}

async function look({ send, evaluate, problems }, file) {
  await send('Page.navigate', { url: pathToFileURL(file).href });
  const until = async (expression) => {
    for (let i = 0; i < 150; ++i) {
      if (await evaluate(expression)) return true;
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
    return false;
  };
  expect(await until(`document.querySelectorAll('.u-over').length === 6`), 'six plots are drawn');
  expect(await evaluate('document.title') === 'A turning body – asterism', 'the title is that of the recording');
  expect(await evaluate(`document.querySelector('.body-name').textContent`) === '</script><b>platform</b>', 'a name stays text');
  expect(await evaluate(`document.body.innerText.includes('lost once')`), 'remarks are shown');

  const frame = () => evaluate(`document.querySelector('.where').textContent`);
  const key = (name) => evaluate(`document.dispatchEvent(new KeyboardEvent('keydown', { key: '${name}', bubbles: true }))`);
  await key('ArrowRight');
  expect((await frame()).startsWith('frame 1 '), 'the arrow key steps one frame');
  const over = await evaluate(`(() => { const r = document.querySelector('#figure-residual .u-over').getBoundingClientRect(); return [r.left + r.width * 21.5 / 39, r.top + 20]; })()`);
  await send('Input.dispatchMouseEvent', { type: 'mouseMoved', x: over[0] - 30, y: over[1] });
  await send('Input.dispatchMouseEvent', { type: 'mouseMoved', x: over[0], y: over[1] });
  expect(await until(`/^frame 2[12] /.test(document.querySelector('.where').textContent)`), `pointing into a plot goes to its frame, not ${await frame()}`);
  expect((await evaluate(`document.querySelector('.readout').innerText`)).includes('no pose is given'), 'a lost body has no pose');

  const ink = `(() => { const c = document.querySelector('.scene canvas'); const t = document.createElement('canvas'); t.width = c.width; t.height = c.height;
    const x = t.getContext('2d'); x.drawImage(c, 0, 0); return x.getImageData(0, 0, t.width, t.height).data.filter((v, i) => i % 4 === 3 && v > 0).length; })()`;
  const empty = await evaluate(ink);
  await key('ArrowLeft');
  await key('ArrowLeft');
  await key('ArrowLeft');
  expect(await until(`${ink} > ${empty}`), 'the 3-D view draws a body when it is found');
  problems.forEach((problem) => failures.push(problem));
}

const program = findChromium();
if (!program) {
  console.log('skipped: no Chromium here (Debian: apt-get install chromium)');
  process.exit(77);
}
const folder = mkdtempSync(join(tmpdir(), 'asterism-report-'));
const file = join(folder, 'report.html');
writeFileSync(file, pageWith(readFileSync(process.argv[2], 'utf8'), recording()));
const browser = await openBrowser(program);
try {
  await look(browser, file);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
failures.forEach((failure) => console.error(`failed: ${failure}`));
console.log(failures.length === 0 ? 'the report page works in a browser' : `${failures.length} failed`);
process.exit(failures.length === 0 ? 0 : 1);
