// Draws plots as the page does, and says what is missing in its SVG: labels, names in the legend,
// the beginnings of lines and areas, and marks. Reads a JSON list of plots, writes a list of lists.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const root = process.argv[2];
const { build } = createRequire(join(root, 'web/package.json'))('esbuild');
const { outputFiles } = await build({ entryPoints: [join(root, 'web/page/plot.ts')], bundle: true, format: 'esm', write: false });
const { draw, placed } = await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString('base64')}`);
const at = (value) => (Math.round(value * 100) / 100).toString();
const escaped = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');

function missing(plot) {
  const svg = draw(plot, { width: 640 });
  const wanted = [];
  let marks = 0;
  for (const { panel, x, y, isLast } of placed(plot, 640)) {
    wanted.push(`>${escaped(panel.y.label)}</text>`, ...(isLast ? [`>${escaped(panel.x.label)}</text>`] : []));
    for (const text of panel.texts) wanted.push(`>${escaped(text.text)}</text>`);
    for (const { kind, name, points, in_legend } of panel.layers) {
      if (in_legend) wanted.push(`>${escaped(name)}</text>`);
      let before = false;
      for (let i = 0; i < points.length; i += 2) {
        const [right, down] = [x(points[i]), y(points[i + 1])];
        const isDrawn = Number.isFinite(right) && Number.isFinite(down);
        if (isDrawn && kind === 'marks') ++marks;
        const isNear = Math.abs(right) < 1e5 && Math.abs(down) < 1e5;
        if (isDrawn && kind !== 'marks' && !before && isNear) wanted.push(`M${at(right)} ${at(down)}`);
        before = isDrawn;
      }
      if (in_legend && kind === 'marks') ++marks;
    }
  }
  const drawn = (svg.match(/<circle|<polygon|<path transform/g) ?? []).length;
  return [...wanted.filter((text) => !svg.includes(text)), ...(drawn === marks ? [] : [`${marks} marks, not ${drawn}`])];
}

const plots = JSON.parse(readFileSync(0, 'utf8'));
for (const plot of plots) {
  for (const layer of plot.columns.flat().flatMap((panel) => panel.layers)) layer.points = Float64Array.from(layer.points.flat(), (value) => value ?? NaN);
}
console.log(JSON.stringify(plots.map((plot) => missing({ ...plot, subtitle: '', moving: null }))));
