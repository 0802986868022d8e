// The canvas of a view, with mouse, touch and keyboard input.

import { onCleanup, onMount, type JSX } from 'solid-js';
import { attachInput } from './input';
import type { Interaction, Surface } from './interaction';
import type { ByHand, Session, Trial } from '../lab/slices';
import './ViewCanvas.css';

export interface Size {
  readonly width: number;
  readonly height: number;
}

export function ViewCanvas(props: {
  lab: Pick<Session, 'canOperate'> & Trial & Pick<ByHand, 'steering'>;
  interaction: Interaction;
  /** How the view moves; it does not if this is not set. */
  surface?: Partial<Surface>;
  label: string;
  class: string;
  helpId: string;
  /** Called once when the canvas is on the page. */
  onCanvas: (canvas: HTMLCanvasElement) => void;
  onSize: (size: Size) => void;
}): JSX.Element {
  const { lab, interaction } = props;
  let canvas!: HTMLCanvasElement;

  onMount(() => {
    const observer = new ResizeObserver(() => {
      props.onSize({ width: canvas.clientWidth, height: canvas.clientHeight });
    });
    observer.observe(canvas);
    const open = new AbortController();
    const surface: Surface = {
      motion: () => undefined,
      key: () => false,
      turned: (arrow) => arrow,
      ...props.surface,
    };
    interaction.enter(surface);
    attachInput(canvas, lab, interaction, surface, open.signal);
    onCleanup(() => {
      observer.disconnect();
      open.abort();
      interaction.leave();
    });
    props.onCanvas(canvas);
  });

  const cursorName = (): string => {
    if (interaction.act().kind === 'held') return 'holding';
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
    />
  );
}
