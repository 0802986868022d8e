// Draws the branches of a comparison as ghosts.

import { ghostAt } from '../../lab/comparison';
import { controllerLabel } from '../../lab/parameters';
import type { ComparisonMessage } from '../../net/protocol.gen';
import { drawGhost } from '../../plan/drawGhost';
import type { View } from '../../plan/transform';
import type { Palette } from '../../ui/palette';

export function drawGhosts(
  ctx: CanvasRenderingContext2D,
  view: View,
  palette: Palette,
  comparison: ComparisonMessage,
  tick: number,
): void {
  for (const branch of comparison.branches) {
    const ghost = ghostAt(comparison, branch, tick);
    if (!ghost) continue;
    drawGhost(ctx, view, palette, {
      ...ghost,
      colour: palette[branch.controller],
      label: controllerLabel(branch),
      path_m: branch.samples.map(([, , x_m, y_m]) => [x_m, y_m] as const),
    });
  }
}
