// The core's plots with their points.
import { short } from './numbers';
import type { Place, Plot } from './plot';
import type * as core from './records';
import { column } from './replies';

/** A picture with a mark that moves: of the present drive, or of a time. */
export function plotOf(plot: core.Plot, numbers: Float64Array, moving: Place | null = null): Plot {
  const columns = plot.columns.map((panels) =>
    panels.map((panel) => ({ ...panel, layers: panel.layers.map((layer) => ({ ...layer, points: column(numbers, layer.points) })) })),
  );
  return {
    title: plot.title,
    subtitle: plot.subtitles.join('; '),
    description: (moving?.y !== undefined ? `You are at ${short(moving.x)}, ${short(moving.y)}. ` : '') + plot.description,
    columns,
    moving,
  };
}
