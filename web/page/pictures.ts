// The core's plots with their points, in the colours of a theme.
import { short } from './numbers';
import type { Place, Plot, Theme } from './plot';
import type * as core from './records';
import { column } from './replies';

/** A colour for white paper, or the same hue for a dark screen. */
function onPaper(colour: string, theme: Theme): string {
  if (theme.paper === '#ffffff') return colour;
  const [red, green, blue] = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255) as [number, number, number];
  const [high, low] = [Math.max(red, green, blue), Math.min(red, green, blue)];
  const lightness = (high + low) / 2;
  const spread = high - low;
  const saturation = spread === 0 ? 0 : spread / (1 - Math.abs(2 * lightness - 1));
  const sixth = spread === 0 ? 0 : high === red ? (green - blue) / spread : high === green ? 2 + (blue - red) / spread : 4 + (red - green) / spread;
  const darkest = 0.12;
  return `hsl(${Math.round(60 * sixth)} ${Math.round(80 * saturation)}% ${Math.round(100 * (1 - (1 - darkest) * lightness))}%)`;
}

/** A picture with a mark that moves: of the present drive, or of a time. */
export function plotOf(plot: core.Plot, numbers: Float64Array, theme: Theme, moving: Place | null = null): Plot {
  const columns = plot.columns.map((panels) =>
    panels.map((panel) => ({
      ...panel,
      layers: panel.layers.map((layer) => ({ ...layer, colour: onPaper(layer.colour, theme), points: column(numbers, layer.points) })),
      texts: panel.texts.map((text) => ({ ...text, colour: onPaper(text.colour, theme) })),
    })),
  );
  const names = columns.flat().flatMap((panel) => panel.layers.map((layer) => layer.name));
  return {
    title: plot.title,
    subtitle: plot.subtitles.join('; '),
    description: (moving?.y !== undefined ? `You are at ${short(moving.x)}, ${short(moving.y)}. ` : '') + [...new Set(names)].filter(Boolean).join(', '),
    columns,
    moving,
  };
}
