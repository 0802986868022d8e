// How a layer looks on the map, small.

import { For, type JSX } from 'solid-js';
import type { MapLayer } from '../plan/layer';
import { type Controller, LOOKS } from '../ui/controllers';

const WIDTH = 30;
const HEIGHT = 16;

const isController = (name: string): name is Controller => name in LOOKS;

type Colours = MapLayer['swatch'];
type Drawing = (colours: Colours) => JSX.Element;

const paint = (name: string): string => `var(--${name})`;

/** One line for each colour; those of controllers have their dashes. */
const lines: Drawing = (colours) => (
  <For each={colours}>
    {(name, index) => {
      const y = (HEIGHT * (index() + 1)) / (colours.length + 1);
      const controller = name.replace(/^m-/, '');
      return (
        <path
          d={`M3 ${y}H27`}
          stroke={paint(name)}
          stroke-width={colours.length > 2 ? 2 : 2.6}
          stroke-dasharray={isController(controller) ? LOOKS[controller].dash.join(' ') : undefined}
        />
      );
    }}
  </For>
);

/** From pale to full, or the colours side by side. */
const ramp: Drawing = (colours) => {
  const [first] = colours;
  const steps =
    colours.length > 1
      ? colours.map((name) => [name, 1] as const)
      : [0.25, 0.6, 1].map((share) => [first, share] as const);
  const width = WIDTH / steps.length;
  return (
    <For each={steps}>
      {([name, opacity], index) => (
        <rect
          x={index() * width}
          width={width}
          height={HEIGHT}
          fill={paint(name)}
          opacity={opacity}
        />
      )}
    </For>
  );
};

const line =
  (d: string, width: number, dash?: string): Drawing =>
  (colours) => (
    <path d={d} stroke={paint(colours.at(-1) ?? '')} stroke-width={width} stroke-dasharray={dash} />
  );

const DRAWINGS: Partial<Record<string, Drawing>> = {
  trail: lines,
  plan: lines,
  ghosts: lines,
  challenge: lines,
  capture: (colours) => (
    <circle
      cx="15"
      cy="17"
      r="13"
      fill={paint('south')}
      fill-opacity="0.15"
      stroke={paint(colours[0])}
      stroke-width="1.6"
    />
  ),
  camera: line('M4 7V3h5M26 7V3h-5M4 9v4h5M26 9v4h-5', 1.8),
  sensed: line('M2 12h8V5h9v6h9', 2.4),
  seen: (colours) => (
    <>
      <rect x="19" width="11" height={HEIGHT} fill={paint(colours[0])} opacity="0.5" />
      <path d="M2 12h8V5h9" stroke={paint(colours.at(-1) ?? '')} stroke-width="2.4" />
    </>
  ),
  blocks: (colours) => (
    <>
      <path d="M4 2h12v12H4zM16 8H4M10 2v12" stroke={paint(colours[0])} stroke-width="1.2" />
      <path d="M18 2h6v6h-6zM24 8h3v3h-3z" fill={paint(colours.at(-1) ?? '')} />
    </>
  ),
  rectangles: line('M4 3h9v10H4zM17 5h9v6h-9z', 1.8),
  obstacles: line('M5 3h20v10H5z', 2, '4 3'),
  flow: line('M3 5h9m-3-2l3 2-3 2M17 11h9m-3-2l3 2-3 2', 1.6),
};

export function LayerSwatch(props: { layer: MapLayer }): JSX.Element {
  return (
    <svg class="swatch" viewBox={`0 0 ${WIDTH} ${HEIGHT}`} aria-hidden="true">
      {(DRAWINGS[props.layer.id] ?? ramp)(props.layer.swatch)}
    </svg>
  );
}
