// SPDX-License-Identifier: Apache-2.0
// A browser driven over its debugging pipe (Chrome DevTools Protocol): no package is needed.
import { spawn, spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

/// The first browser that answers; undefined when there is none.
export function findChromium() {
  const names = [process.env.CHROMIUM, 'chromium', 'chromium-browser', 'google-chrome'].filter(Boolean);
  return names.find((name) => spawnSync(name, ['--version'], { stdio: 'ignore' }).status === 0);
}

/// Starts the browser with one page: `send` speaks to it, `evaluate` runs an expression in it, `problems`
/// collects errors of its scripts and everything it asked the network for.
export async function openBrowser(program) {
  const profile = mkdtempSync(join(tmpdir(), 'asterism-browser-'));
  const flags = ['--headless=new', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--disable-dev-shm-usage', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
    '--window-size=1400,1000', `--user-data-dir=${profile}`, '--remote-debugging-pipe', 'about:blank'];
  const browser = spawn(program, flags, { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
  const waiting = new Map();
  const listeners = [];
  let last = 0;
  let text = '';
  browser.stdio[4].on('data', (data) => {
    const messages = (text + data).split('\0');
    text = messages.pop();
    for (const message of messages.map((m) => JSON.parse(m))) {
      const asked = waiting.get(message.id);
      if (!asked) listeners.forEach((listen) => listen(message));
      else if (message.error) asked.reject(new Error(message.error.message));
      else asked.resolve(message.result);
      waiting.delete(message.id);
    }
  });
  const call = (method, params = {}, sessionId = undefined) => new Promise((resolve, reject) => {
    waiting.set(++last, { resolve, reject });
    browser.stdio[3].write(`${JSON.stringify({ id: last, method, params, sessionId })}\0`);
  });

  const { targetInfos } = await call('Target.getTargets');
  const { sessionId } = await call('Target.attachToTarget', { targetId: targetInfos.find((t) => t.type === 'page').targetId, flatten: true });
  const send = (method, params) => call(method, params, sessionId);
  const problems = [];
  listeners.push(({ method, params }) => {
    if (method === 'Runtime.exceptionThrown') problems.push(`script error: ${params.exceptionDetails.exception?.description ?? params.exceptionDetails.text}`);
    if (method === 'Runtime.consoleAPICalled' && params.type === 'error') problems.push(`console error: ${params.args.map((a) => a.value ?? a.description).join(' ')}`);
    if (method === 'Network.requestWillBeSent' && !/^(file|data|blob):/.test(params.request.url)) problems.push(`asked the network for ${params.request.url}`);
  });
  await Promise.all([send('Runtime.enable'), send('Network.enable'), send('Page.enable')]);
  const evaluate = async (expression) => {
    const { result, exceptionDetails } = await send('Runtime.evaluate', { expression, returnByValue: true, awaitPromise: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  };
  const close = async () => {
    const ended = new Promise((resolve) => browser.on('exit', resolve));
    await call('Browser.close').catch(() => {});
    await ended;
    rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
  };
  return { send, evaluate, problems, close };
}
