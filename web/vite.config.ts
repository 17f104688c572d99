// SPDX-License-Identifier: Apache-2.0
import { defineConfig, type Plugin } from 'vite';

/// Puts the script and the styles into the page, so that one file opens from disk. A classic script: browsers
/// load no modules from file://.
function oneFile(): Plugin {
  return {
    name: 'one-file',
    enforce: 'post',
    generateBundle(_, bundle) {
      const page = bundle['report.html'];
      if (page?.type !== 'asset') throw new Error('the build made no report.html');
      let html = String(page.source).replace(/<script type="module".*?<\/script>|<link rel="(stylesheet|modulepreload)".*?>/g, '');
      for (const [name, part] of Object.entries(bundle)) {
        if (name === 'report.html') continue;
        const text = part.type === 'chunk' ? part.code : String(part.source);
        const inside = part.type === 'chunk'
          ? `<script>${text.replace(/<\/(script)/gi, '<\\/$1')}</script>`
          : `<style>${text}</style>`;
        const before = part.type === 'chunk' ? '</body>' : '</head>';
        html = html.replace(before, () => inside + before);
        delete bundle[name];
      }
      page.source = html;
    },
  };
}

export default defineConfig({
  plugins: [oneFile()],
  build: {
    target: 'es2021',
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    chunkSizeWarningLimit: 1500,
    emptyOutDir: true,
    rollupOptions: { input: 'report.html', output: { format: 'iife' } },
  },
});
