import { describe, expect, it } from 'vitest';
import { Pressed } from './pressed';

describe('pressed pointers', () => {
  it('move the plan, but not within a tap', () => {
    const pressed = new Pressed();
    expect(pressed.press(1, [100, 100])).toBe(false);
    expect(pressed.move(1, [105, 100])).toBeUndefined();
    expect(pressed.move(1, [110, 101])).toEqual({ type: 'pan', by: [5, 1] });
  });

  it('zoom the plan by two, around the other one', () => {
    const pressed = new Pressed();
    pressed.press(1, [100, 100]);
    expect(pressed.press(2, [200, 100])).toBe(true);
    expect(pressed.move(2, [250, 100])).toEqual({ type: 'zoom', at: [100, 100], by: 1.5 });
    expect(pressed.move(1, [175, 100])).toEqual({ type: 'zoom', at: [250, 100], by: 0.5 });
  });

  it('zoom by the first two, while a third one does nothing', () => {
    const pressed = new Pressed();
    pressed.press(1, [100, 100]);
    pressed.press(2, [200, 100]);
    expect(pressed.press(3, [300, 100]), 'it is neither a tap nor a drag').toBe(true);
    expect(pressed.move(3, [350, 100])).toBeUndefined();
    expect(pressed.move(2, [300, 100])).toEqual({ type: 'zoom', at: [100, 100], by: 2 });
    // When the first one is released, the other two zoom.
    pressed.forget(1);
    expect(pressed.move(3, [400, 100])).toEqual({ type: 'zoom', at: [300, 100], by: 2 });
  });

  it('that were released or never pressed do nothing', () => {
    const pressed = new Pressed();
    pressed.press(1, [100, 100]);
    pressed.forget(1);
    expect(pressed.move(1, [300, 100])).toBeUndefined();
    expect(pressed.move(7, [300, 100])).toBeUndefined();
    expect(pressed.press(2, [200, 100])).toBe(false);
  });
});
