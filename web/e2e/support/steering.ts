// Hands that steer the tool with the controller You: by mouse, touch, arrow keys and gamepad.

import type { Lab } from './lab';
import { type Point, distance } from './table';

export interface Hand {
  /** Points or leans toward a place. */
  toward(place: Point): Promise<void>;
  release(): Promise<void>;
}

/** Nearer than this, keys and stick are released. */
const NEAR_M = 0.004;

const toolOf = (lab: Lab): Point => [lab.state.tool_m[0], lab.state.tool_m[1]];

async function byMouse(lab: Lab): Promise<Hand> {
  const { mouse } = lab.page;
  await mouse.move(...(await lab.px(toolOf(lab))));
  await mouse.down();
  return {
    toward: async (place) => mouse.move(...(await lab.px(place))),
    release: () => mouse.up(),
  };
}

async function byTouch(lab: Lab): Promise<Hand> {
  const client = await lab.page.context().newCDPSession(lab.page);
  const touch = async (type: 'touchStart' | 'touchMove' | 'touchEnd', at?: Point) => {
    const [x, y] = at ? await lab.px(at) : [0, 0];
    await client.send('Input.dispatchTouchEvent', { type, touchPoints: at ? [{ x, y }] : [] });
  };
  await touch('touchStart', toolOf(lab));
  return {
    toward: (place) => touch('touchMove', place),
    release: () => touch('touchEnd'),
  };
}

async function byKeys(lab: Lab): Promise<Hand> {
  const { keyboard } = lab.page;
  await lab.canvas.focus();
  const pressed = new Set<string>();
  const hold = async (wanted: readonly string[]) => {
    for (const key of [...pressed].filter((key) => !wanted.includes(key))) {
      await keyboard.up(key);
      pressed.delete(key);
    }
    for (const key of wanted.filter((key) => !pressed.has(key))) {
      await keyboard.down(key);
      pressed.add(key);
    }
  };
  return {
    toward: ([x, y]) => {
      const [dx, dy] = [x - lab.state.tool_m[0], y - lab.state.tool_m[1]];
      const keys = [];
      if (Math.abs(dx) > NEAR_M) keys.push(dx > 0 ? 'ArrowRight' : 'ArrowLeft');
      if (Math.abs(dy) > NEAR_M) keys.push(dy > 0 ? 'ArrowUp' : 'ArrowDown');
      return hold(keys);
    },
    release: () => hold([]),
  };
}

interface Pad {
  axes: number[];
  buttons: { pressed: boolean }[];
}

/** Puts a gamepad into the page; `push` moves its stick and presses its first button. */
export async function injectGamepad({ page }: Lab) {
  await page.evaluate(() => {
    const pad = {
      id: 'Test pad',
      mapping: 'standard',
      axes: [0, 0, 0, 0],
      buttons: Array.from({ length: 17 }, () => ({ pressed: false })),
    };
    Object.assign(window, { pad });
    navigator.getGamepads = () => [pad as unknown as Gamepad];
  });
  /** Up is negative on a stick. */
  return ([x, y]: Point, isHeld = false) =>
    page.evaluate(
      ([right, down, held]) => {
        const { pad } = window as unknown as { pad: Pad };
        [pad.axes[0], pad.axes[1]] = [right, down];
        pad.buttons[0] = { pressed: held };
      },
      [x, -y, isHeld] as const,
    );
}

async function byGamepad(lab: Lab): Promise<Hand> {
  const push = await injectGamepad(lab);
  return {
    toward: (place) => {
      const tool = toolOf(lab);
      const off_m = distance(tool, place);
      if (off_m < NEAR_M) return push([0, 0]);
      return push([(place[0] - tool[0]) / off_m, (place[1] - tool[1]) / off_m]);
    },
    release: () => push([0, 0]),
  };
}

export const HANDS = { mouse: byMouse, touch: byTouch, keys: byKeys, gamepad: byGamepad };
