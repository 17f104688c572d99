// SPDX-License-Identifier: Apache-2.0
// node report_smoke.mjs PAGE: opens the built report page from disk, with a small recording, with a few layouts,
// with a cell in motion and with scans, as a reader would, and asks whether it shows what it should. Ends with 77 (skipped) where there is no Chromium.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { cell, moved } from './cell_fixture.mjs';
import { findChromium, openBrowser } from './chromium.mjs';
import { layouts } from './layout_fixture.mjs';
import { pageWith } from './page_with.mjs';
import { scans } from './scan_fixture.mjs';

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

const failures = [];
function expect(holds, what) {
  if (!holds) failures.push(what);
}

async function open({ send, evaluate }, file) {
  await send('Page.navigate', { url: pathToFileURL(file).href });
  return async (expression) => {
    for (let i = 0; i < 150; ++i) {
      if (await evaluate(expression)) return true;
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
    return false;
  };
}

/// How many points of the 3-D view are drawn upon.
const kInk = `(() => { const c = document.querySelector('.scene canvas'); const t = document.createElement('canvas'); t.width = c.width; t.height = c.height;
  const x = t.getContext('2d'); x.drawImage(c, 0, 0); return x.getImageData(0, 0, t.width, t.height).data.filter((v, i) => i % 4 === 3 && v > 0).length; })()`;

async function lookAtRecording(browser, file) {
  const { send, evaluate } = browser;
  const until = await open(browser, file);
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

  const empty = await evaluate(kInk);
  await key('ArrowLeft');
  await key('ArrowLeft');
  await key('ArrowLeft');
  expect(await until(`${kInk} > ${empty}`), 'the 3-D view draws a body when it is found');
}

async function lookAtLayouts(browser, file) {
  const { send, evaluate } = browser;
  const until = await open(browser, file);
  const chosen = () => evaluate(`document.querySelector('.chosen h2').textContent`);
  expect(await until(`document.querySelectorAll('.u-over').length === 4 && document.querySelectorAll('#figure-pareto .pick').length === 9`), 'the front, the given layout and four plots are drawn');
  expect(await evaluate('document.title') === 'Layouts of the platform – asterism', 'the title is that of the layouts');
  expect((await chosen()).startsWith('7 targetsknee'), `the page opens at the knee, not ${await chosen()}`);
  expect(await evaluate(`document.querySelector('.chosen').innerText.includes('an eighth wins 6 %')`), 'the knee is given its reason');
  expect(await evaluate(`[...document.querySelectorAll('#figure-pareto text')].some((t) => t.textContent === 'knee: 7 targets')`), 'the knee is named in the chart');
  expect(await evaluate(`document.querySelectorAll('tbody th button.link').length >= 10 && document.body.innerText.includes('</script><b>Table 1 S1</b>')`), 'all layouts are in the table and names stay text');
  expect(await until(`${kInk} > 5000`), 'the 3-D view draws the layout');

  const press = async (key) => {
    await send('Input.dispatchKeyEvent', { type: 'keyDown', key, code: key, windowsVirtualKeyCode: key === 'ArrowRight' ? 39 : 37 });
    await send('Input.dispatchKeyEvent', { type: 'keyUp', key, code: key });
  };
  await evaluate(`document.querySelector('#figure-pareto .chart svg').focus()`);
  await press('ArrowRight');
  await press('ArrowRight');
  expect((await chosen()).startsWith('9 targets'), `the arrow keys go along the chart, also twice, not to ${await chosen()}`);
  expect((await evaluate(`document.querySelector('.where').textContent`)).startsWith('pose 0 '), 'and leave the pose alone');
  await evaluate(`document.activeElement.blur()`);
  await press('ArrowRight');
  expect((await evaluate(`document.querySelector('.where').textContent`)).startsWith('pose 1 '), 'elsewhere they step through the motion');

  const at = await evaluate(`(() => { const r = document.querySelector('#figure-pareto .pick').getBoundingClientRect(); return [r.left + r.width / 2, r.top + r.height / 2]; })()`);
  await send('Input.dispatchMouseEvent', { type: 'mousePressed', x: at[0], y: at[1], button: 'left', clickCount: 1 });
  await send('Input.dispatchMouseEvent', { type: 'mouseReleased', x: at[0], y: at[1], button: 'left', clickCount: 1 });
  expect(await until(`document.querySelector('.chosen h2').textContent.startsWith('4 targets')`), `a click into the chart chooses that layout, not ${await chosen()}`);
  await evaluate(`[...document.querySelectorAll('button.sort')].find((b) => b.textContent.startsWith('worst error after')).click()`);
  expect(await evaluate(`document.querySelector('.wide-table tbody th').textContent`) === '12 targets', 'a heading orders the table, the best first');
  await evaluate(`[...document.querySelectorAll('.chosen button.link')][1].click()`);
  expect((await chosen()).startsWith('12 targets'), 'what is given up leads to the layout that has it');
}

/// How many points of the 3-D view, names and colour bar upon it have about this colour.
const inColour = (r, g, b) => `(() => [...document.querySelectorAll('.scene canvas')].reduce((sum, c) => { const t = document.createElement('canvas'); t.width = c.width; t.height = c.height;
  const x = t.getContext('2d'); x.drawImage(c, 0, 0); const d = x.getImageData(0, 0, t.width, t.height).data; let n = 0;
  for (let i = 0; i < d.length; i += 4) if (d[i + 3] > 200 && Math.abs(d[i] - ${r}) + Math.abs(d[i + 1] - ${g}) + Math.abs(d[i + 2] - ${b}) < 24) ++n; return sum + n; }, 0))()`;
const kYellow = inColour(253, 231, 37);  // the bright end of the error map's colours
const kRay = inColour(176, 137, 0);

async function lookAtCell(browser, file, data) {
  const { send, evaluate } = browser;
  const until = await open(browser, file);
  const plots = 4;
  expect(await until(`document.querySelectorAll('.u-over').length === ${plots}`), 'the four plots over the motion are drawn');
  expect(await until(`${kInk} > 5000`), 'the 3-D view draws the cell');
  expect(await evaluate('document.title') === 'Engine casing on the tilting platform – asterism', 'the title is that of the cell');
  expect(await evaluate(`document.body.innerText.includes('</script><b>backlight</b>')`), 'names stay text');

  const readout = () => evaluate(`document.querySelector('.readout tbody tr').innerText`);
  const words = await readout();
  const slide = (to) => evaluate(`(() => { const s = document.querySelector('.timeline input'); s.value = ${to}; s.dispatchEvent(new Event('input', { bubbles: true })); })()`);
  await slide(12);
  expect((await evaluate(`document.querySelector('.where').textContent`)).startsWith('frame 12 '), 'the slider goes to its frame');
  expect(await readout() !== words, 'the slider moves the platform: other numbers');
  const blocked = data.time_s.findIndex((_, i) => data.bodies[0].sight.some(([left]) => left[i] === 'a'));
  await slide(blocked);
  expect(await evaluate(`document.querySelector('.sight-words').textContent.includes('hidden by casing')`), 'what hides a target is said in words');

  const toggle = (layer) => evaluate(`[...document.querySelectorAll('.layers label')].find((l) => l.textContent === '${layer}').firstChild.click()`);
  const press = (text) => evaluate(`[...document.querySelectorAll('button')].find((b) => b.textContent === '${text}').click()`);
  const picture = async () => {
    await evaluate(`new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)))`);
    return evaluate(`document.querySelector('.scene canvas').toDataURL()`);
  };
  // Two moments in which every target is seen alike: with lines and ellipsoids off, only what moves can differ.
  const alike = (i) => data.bodies.every(({ sight }) => sight.flat().every((letters) => letters[i] === letters[i + 1]));
  const still = data.time_s.findIndex((_, i) => i + 1 < data.time_s.length && alike(i));
  for (const layer of ['sight lines', 'error ellipsoids']) await toggle(layer);
  await slide(still);
  const [drawn, same] = [await picture(), await picture()];
  await slide(still + 1);
  expect(drawn === same && await picture() !== drawn, 'the slider moves the platform: another picture');
  for (const layer of ['sight lines', 'error ellipsoids']) await toggle(layer);
  await slide(blocked);
  await picture();

  const rays = await evaluate(kRay);
  await toggle('sight lines');
  expect(await until(`${kRay} < ${rays / 4}`), `sight lines can be switched off (${rays} points of their colour, then ${await evaluate(kRay)})`);
  await toggle('sight lines');
  const yellow = await evaluate(kYellow);
  await press('error map');
  expect(await until(`${kYellow} > ${yellow + 50}`), 'the error map and its colour bar are drawn');
  expect(await evaluate(`getComputedStyle(document.querySelector('.map-words')).display`) !== 'none', 'and explained');
  await press('shaded');

  await measureInCell(browser, data, until, press);
  expect(await evaluate(`document.querySelectorAll('.heat rect').length`) > 2 * 13 * 13, 'the heat maps are drawn');
  expect(await evaluate(`document.querySelectorAll('.chart-figure svg circle').length`) > 20, 'the charts are drawn');
  expect(await evaluate(`document.querySelectorAll('.generic tbody tr').length`) === 10, 'the tables have their rows');
  expect(await evaluate(`document.querySelectorAll('.generic tr.bad .verdict').length`) === 1, 'a verdict is marked');
}

/// Two clicks where the view shows two targets that nothing hides: their distance is known.
async function measureInCell({ send, evaluate }, data, until, press) {
  await press('cell');
  await press('Measure');
  const names = ['P9', 'P5'];
  const places = names.map((name) => data.bodies[0].targets.find((target) => target.id === name).position_mm);
  const frame = await evaluate(`Number(document.querySelector('.timeline input').value)`);
  for (const place of places) {
    await new Promise((resolve) => setTimeout(resolve, 100));
    const at = await evaluate(`(() => { const c = document.querySelector('.scene canvas'); const r = c.getBoundingClientRect(); const [x, y] = c.project(${JSON.stringify(moved(data.bodies[0].pose[frame], place))}); return [r.left + x, r.top + y]; })()`);
    await send('Input.dispatchMouseEvent', { type: 'mousePressed', x: at[0], y: at[1], button: 'left', clickCount: 1 });
    await send('Input.dispatchMouseEvent', { type: 'mouseReleased', x: at[0], y: at[1], button: 'left', clickCount: 1 });
  }
  const true_mm = Math.hypot(...places[0].map((v, k) => v - places[1][k]));
  expect(await until(`document.querySelector('.measured .length') !== null`), 'two clicks measure');
  const told = await evaluate(`document.querySelector('.measured .length')?.textContent ?? ''`);
  // The clicks snap to the targets' centres: what is told is exact to the last digit that is written.
  expect(Math.abs(parseFloat(told) - true_mm) < 0.006, `the distance is ${true_mm.toFixed(2)} mm, not ${told}`);
  expect(await evaluate(`document.querySelectorAll('.measured tbody tr').length`) === 2, 'along the axes of the tracker and of the part');
  await evaluate(`document.dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape', bubbles: true }))`);
  expect(await evaluate(`document.querySelector('.measured .length')`) === null, 'Esc forgets what was measured');
}

const kMissing = inColour(217, 84, 30);   // not measured, in the light theme; shaded a little
const kChosen = inColour(245, 183, 0);
const kPicture = `new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => resolve(document.querySelector('.scene canvas').toDataURL()))))`;

async function lookAtScans(browser, file, data) {
  const { send, evaluate } = browser;
  const until = await open(browser, file);
  expect(await until(`document.querySelectorAll('#figure-coverage circle').length === ${data.rounds[0].plan.views.length}`), 'coverage has a mark a view');
  expect(await until(`${kInk} > 5000`), 'the 3-D view draws the part with the plan');
  expect(await evaluate('document.title') === 'Conical casing: where to scan, and one true cloud – asterism', 'the title is that of the scans');
  expect(await evaluate(`document.body.innerText.includes('</script><b>platform turned')`), 'a round\'s name stays text');
  expect(await evaluate(`[...document.querySelectorAll('#figure-coverage text')].some((t) => t.textContent.startsWith('this plan '))`), 'what the plan covers is named');
  expect(await evaluate(`document.querySelectorAll('#figure-deviation rect').length`) === 61, 'the histogram has its bins');
  expect(await evaluate(`document.querySelectorAll('#figure-limits rect').length`) === 9, 'each limit has its bar');
  const named = await evaluate(`(() => { const boxes = [...document.querySelectorAll('#figure-coverage g > text')].map((t) => t.getBoundingClientRect()); return boxes.some((a, i) => boxes.some((b, k) => k > i && a.left < b.right && b.left < a.right && a.top < b.bottom - 2 && b.top < a.bottom - 2)); })()`);
  expect(!named, 'no name in the coverage covers another');

  const press = (text) => evaluate(`[...document.querySelectorAll('button')].find((b) => b.textContent.trim() === '${text}').click()`);
  const key = (name, shift = false) => evaluate(`document.dispatchEvent(new KeyboardEvent('keydown', { key: '${name}', shiftKey: ${shift}, bubbles: true }))`);
  const pointed = () => evaluate(`document.querySelector('.pointed').textContent`);
  await key('ArrowRight', true);
  expect((await pointed()).startsWith('View 1: mean incidence'), `Shift and an arrow choose a view, not "${await pointed()}"`);
  expect(await until(`${kChosen} > 100`), 'what the chosen view measures is lit');
  await evaluate(`document.querySelectorAll('#figure-tour g.pick')[2].dispatchEvent(new MouseEvent('click', { bubbles: true }))`);
  expect((await pointed()).startsWith('View 3: mean incidence 18.4°, σ not determined'), 'a block of the tour chooses its view, and what is not known is said');
  await key('Escape');
  expect(await until(`${kChosen} === 0`), 'Esc lets go of it');

  await press('cloud');
  expect(await evaluate(`document.querySelector('.scene-key').textContent.includes(' of 50\u202f000 points are drawn')`), 'it is said how many points are drawn');
  await measureOnCloud(browser, until);
  await press('completeness');
  expect(await until(`${kMissing} > 100`), 'what is not measured is coloured');
  const rows = await evaluate(`document.querySelectorAll('#holes-1-title').length && [...document.querySelectorAll('.round-tables section')][1].querySelectorAll('tbody tr').length`);
  expect(rows === data.rounds[0].completeness.holes.length, 'the holes are listed');
  const drawn = await evaluate(kPicture);
  await evaluate(`[...document.querySelectorAll('.round-tables section')][1].querySelector('tbody button').click()`);
  expect(await evaluate(kPicture) !== drawn, 'a hole of the list is shown');

  await key('ArrowRight');
  expect(await evaluate(`document.querySelector('#views-2-title') !== null && document.querySelector('.rounds tr.active').textContent.includes('platform turned')`), 'an arrow key goes to the next round');
  await press('side by side');
  expect(await until(`document.querySelectorAll('.scenes.pair .scene').length === 2`), 'two rounds stand side by side');
  await press('off');
  expect(await evaluate(`document.querySelectorAll('.scene')[1].hidden`), 'and one alone again');
}

/// Two clicks where the view shows the part's wall: the points' distance is told.
async function measureOnCloud({ send, evaluate }, until) {
  await evaluate(`document.querySelector('.scene').scrollIntoView({ block: 'center', behavior: 'instant' })`);
  await new Promise((resolve) => setTimeout(resolve, 300));
  for (const place of [[0.66 * 490, -0.75 * 490, 250], [0.8 * 490, -0.6 * 490, 350]]) {
    const at = await evaluate(`(() => { const c = document.querySelector('.scene canvas'); const r = c.getBoundingClientRect(); const [x, y] = c.project(${JSON.stringify(place)}); return [r.left + x, r.top + y]; })()`);
    await send('Input.dispatchMouseEvent', { type: 'mouseMoved', x: at[0], y: at[1] });
    expect(await until(`/deviation .* scan \\d/.test(document.querySelector('.pointed').textContent)`), 'the point under the cursor is told');
    await send('Input.dispatchMouseEvent', { type: 'mousePressed', x: at[0], y: at[1], button: 'left', clickCount: 1 });
    await send('Input.dispatchMouseEvent', { type: 'mouseReleased', x: at[0], y: at[1], button: 'left', clickCount: 1 });
  }
  expect(await until(`document.querySelector('.measured .length') !== null`), 'two clicks measure on the cloud');
  const told = parseFloat(await evaluate(`document.querySelector('.measured .length')?.textContent ?? ''`));
  // 141 mm between the places that were clicked; the drawn points lie some 25 mm apart.
  expect(Math.abs(told - 141) < 50, `the distance is about 141 mm, not ${told}`);
  await evaluate(`document.dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape', bubbles: true }))`);
  expect(await evaluate(`document.querySelector('.measured .length')`) === null, 'Esc forgets what was measured on the cloud');
}

const program = findChromium();
if (!program) {
  console.log('skipped: no Chromium here (Debian: apt-get install chromium)');
  process.exit(77);
}
const folder = mkdtempSync(join(tmpdir(), 'asterism-report-'));
const template = readFileSync(process.argv[2], 'utf8');
const fileWith = (name, data) => {
  writeFileSync(join(folder, name), pageWith(template, data));
  return join(folder, name);
};
const browser = await openBrowser(program);
try {
  await lookAtRecording(browser, fileWith('report.html', recording()));
  await lookAtLayouts(browser, fileWith('layouts.html', layouts()));
  const small = cell({ frames: 40, sides: 24, longest: 200 });
  await lookAtCell(browser, fileWith('cell.html', small), small);
  const scanned = scans({ points: 4000, samples: 1200, sides: 48, total: 50000 });
  await lookAtScans(browser, fileWith('scans.html', scanned), scanned);
  browser.problems.forEach((problem) => failures.push(problem));
} finally {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
failures.forEach((failure) => console.error(`failed: ${failure}`));
console.log(failures.length === 0 ? 'the report page works in a browser' : `${failures.length} failed`);
process.exit(failures.length === 0 ? 0 : 1);
