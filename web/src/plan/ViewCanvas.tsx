// The canvas of a view, with mouse, touch and keyboard input.

import { createEffect, createSignal, onCleanup, onMount, type JSX } from 'solid-js';
import { attachInput } from './input';
import type { Interaction, Surface } from './interaction';
import { Moments } from './Moments';
import type { ByHand, Session, Trial } from '../lab/slices';
import { onSize, type Size } from '../ui/size';
import type { ViewPicture } from './viewPicture';
import './ViewCanvas.css';

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
  /** Undefined until the view can be drawn. */
  draw: ViewPicture['draw'] | undefined;
  /** Called with the view when it can be drawn, and with nothing when it closes. */
  onPicture?: ((picture: ViewPicture | undefined) => void) | undefined;
}): JSX.Element {
  const { lab, interaction } = props;
  let canvas!: HTMLCanvasElement;
  const [size, setSize] = createSignal<Size>({ width: 0, height: 0 });

  onMount(() => {
    onSize(canvas, setSize);
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
      open.abort();
      interaction.leave();
      props.onPicture?.(undefined);
    });
    props.onCanvas(canvas);
  });

  createEffect(() => {
    const { draw } = props;
    props.onSize(size());
    if (draw && size().width > 0) props.onPicture?.({ size: size(), draw });
  });

  const cursorName = (): string => {
    if (interaction.act().kind === 'held') return 'holding';
    if (lab.steering.isActive()) return 'steering';
    if (interaction.reachPx() !== undefined) return 'near-bead';
    return interaction.isPressable() ? 'pressable' : 'free';
  };

  return (
    <>
      <canvas
        ref={canvas}
        class={`stage-canvas ${props.class}`}
        tabindex="0"
        role="application"
        aria-label={props.label}
        aria-describedby={props.helpId}
        data-cursor={cursorName()}
      />
      <Moments lab={lab} interaction={interaction} />
    </>
  );
}
