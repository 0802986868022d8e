// The canvas of a view, with mouse, touch and keyboard input.

import { createEffect, onCleanup, onMount, type JSX } from 'solid-js';
import { attachKeyboard } from './keyboard';
import { attachPointer } from './pointer';
import type { Interaction } from './interaction';
import type { Vec2 } from '../lab/geometry';
import { isAtStake } from '../lab/contest';
import { attachSteering } from './steerInput';
import type { ByHand, Trial } from '../lab/slices';
import './ViewCanvas.css';

export interface Size {
  readonly width: number;
  readonly height: number;
}

export function ViewCanvas(props: {
  lab: Trial & Pick<ByHand, 'steering'>;
  interaction: Interaction;
  label: string;
  class: string;
  helpId: string;
  /** Called once when the canvas is on the page. Its listeners run after those of the hand. */
  onCanvas: (canvas: HTMLCanvasElement) => void;
  onSize: (size: Size) => void;
  /** Direction of an arrow key on the table; by default the direction on the screen. */
  turned?: (arrow: Vec2) => Vec2;
}): JSX.Element {
  const { lab, interaction } = props;
  let canvas!: HTMLCanvasElement;

  onMount(() => {
    const observer = new ResizeObserver(() => {
      props.onSize({ width: canvas.clientWidth, height: canvas.clientHeight });
    });
    observer.observe(canvas);
    const steered = new AbortController();
    attachSteering(
      canvas,
      lab.steering,
      {
        view: interaction.view,
        isPicking: interaction.picker.isPicking,
        isAtStake: () => isAtStake(lab),
        onPointing: (px) => interaction.setPointing({ px, reachPx: 0 }),
        turned: (arrow) => props.turned?.(arrow) ?? arrow,
      },
      steered.signal,
    );
    const detach = attachPointer(
      canvas,
      lab,
      interaction.hand,
      interaction.view,
      interaction.setPointing,
      interaction.grabPx,
    );
    const cursor = {
      at: interaction.cursor,
      put: interaction.setCursor,
      turned: (arrow: Vec2) => props.turned?.(arrow) ?? arrow,
    };
    attachKeyboard(
      canvas,
      lab,
      interaction.hand,
      cursor,
      interaction.place,
      interaction.picker.cancel,
    );
    onCleanup(() => {
      observer.disconnect();
      detach();
      steered.abort();
      interaction.leave();
    });
    props.onCanvas(canvas);
  });

  // For tests and other tools that read the page.
  createEffect(() => {
    const state = lab.state();
    if (!state) return;
    canvas.dataset.tick = String(state.tick);
    canvas.dataset.bead = state.bead_m.slice(0, 2).join(',');
    canvas.dataset.tool = state.tool_m.slice(0, 2).join(',');
    canvas.dataset.goal = state.goal_m?.slice(0, 2).join(',') ?? '';
  });

  const cursorName = (): string => {
    if (interaction.hand.drag().kind === 'held') return 'holding';
    if (lab.steering.isActive()) return 'steering';
    return interaction.reachPx() === undefined ? 'free' : 'near-bead';
  };

  return (
    <canvas
      ref={canvas}
      class={`stage-canvas ${props.class}`}
      tabindex="0"
      role="application"
      aria-label={props.label}
      aria-describedby={props.helpId}
      data-cursor={cursorName()}
      onFocus={() => {
        interaction.setFocused(true);
      }}
      onBlur={() => {
        interaction.setFocused(false);
      }}
    />
  );
}
