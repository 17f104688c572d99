// SPDX-License-Identifier: Apache-2.0
/// The built page with `data` in its data block, as the program writes it.
export function pageWith(template, data) {
  const open = 'id="report-data">';
  const begin = template.indexOf(open) + open.length;
  return template.slice(0, begin) + JSON.stringify(data).replace(/</g, '\\u003c') + template.slice(template.indexOf('</script>', begin));
}
