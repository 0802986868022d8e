import { describe, expect, it } from 'vitest';
import { BLANK, type Mm, type Shape } from './drawing';
import { after, begin, type Editing, pending, shift, type Step } from './editing';

const click = (...at: Mm): Step => ({ type: 'click', at, slop_mm: 2 });
const drag = (...at: Mm): Step => ({ type: 'drag', at, slop_mm: 2 });
const DROP: Step = { type: 'drop' };

const run = (steps: readonly Step[], from: Editing = begin(BLANK)): Editing =>
  steps.reduce(after, from);
const shapesOf = (steps: readonly Step[], from?: Editing): readonly Shape[] =>
  run(steps, from).drawing.shapes;
const tool = (name: Editing['tool']): Step => ({ type: 'tool', tool: name });

describe('a wall', () => {
  it('has corners on the grid, and ends where the last one is clicked again', () => {
    const begun = [click(1, 301), click(51, 299), click(52, 352)];
    expect(shapesOf(begun)).toEqual([]);
    expect(pending(run(begun), [90, 351])).toMatchObject({
      points: [
        [0, 300],
        [50, 300],
        [50, 350],
        [90, 350],
      ],
    });
    const wall = {
      kind: 'wall',
      points: [
        [0, 300],
        [50, 300],
        [50, 350],
      ],
      width_mm: 12,
    };
    expect(shapesOf([...begun, click(50, 350)])).toEqual([wall]);
    expect(shapesOf([...begun, { type: 'finish' }])).toEqual([wall]);
    expect(run([...begun, { type: 'back' }]).corners).toEqual([
      [0, 300],
      [50, 300],
    ]);
    expect(run([...begun, { type: 'cancel' }])).toMatchObject({ corners: [], drawing: BLANK });
  });

  it('is finished when another tool is chosen', () => {
    expect(shapesOf([click(0, 300), click(50, 300), tool('post')])).toHaveLength(1);
  });

  it('is drawn by hand without the grid, and stays in the frame', () => {
    const drawn = shapesOf([drag(1, 301), drag(20, 302), drag(400, 303), DROP]);
    expect(drawn).toMatchObject([{ kind: 'wall', width_mm: 12 }]);
    expect(drawn[0]?.kind === 'wall' && drawn[0].points.at(-1)).toEqual([280, 303]);
  });

  it('has a width', () => {
    const steps: Step[] = [
      { type: 'set', settings: { size_mm: { wall: 30, post: 30, erase: 40 } } },
      click(0, 300),
      { type: 'finish' },
    ];
    expect(shapesOf(steps)).toMatchObject([{ width_mm: 30 }]);
  });
});

it('finishes what is begun before all is mirrored', () => {
  const steps: Step[] = [click(0, 300), click(50, 300), { type: 'mirror', axis: 'sides' }];
  expect(shapesOf(steps)).toMatchObject([
    {
      points: [
        [-20, 300],
        [-70, 300],
      ],
    },
  ]);
});

describe('an area', () => {
  it('is a rectangle when dragged, and none when it is too small', () => {
    const rectangle = [
      [0, 300],
      [40, 300],
      [40, 330],
      [0, 330],
    ];
    expect(shapesOf([tool('area'), drag(1, 301), drag(39, 331), DROP])).toEqual([
      { kind: 'area', rings: [rectangle] },
    ]);
    expect(shapesOf([tool('area'), drag(1, 301), drag(39, 301), DROP])).toEqual([]);
  });

  it('ends where its first corner is clicked again', () => {
    const ring = [
      [0, 300],
      [40, 300],
      [40, 330],
    ];
    const steps = [tool('area'), click(0, 300), click(40, 300), click(40, 330), click(1, 300)];
    expect(shapesOf(steps)).toEqual([{ kind: 'area', rings: [ring] }]);
    // Two corners are not an area: they stay.
    expect(run([...steps.slice(0, 3), { type: 'finish' }])).toMatchObject({
      corners: ring.slice(0, 2),
    });
    expect(shapesOf([...steps.slice(0, 3), tool('wall')])).toEqual([]);
  });
});

it('puts posts, dragged ones with their own size, and copies on the other side', () => {
  expect(shapesOf([tool('post'), click(1, 299)])).toEqual([
    { kind: 'post', center: [0, 300], radius_mm: 15 },
  ]);
  expect(shapesOf([tool('post'), drag(0, 300), drag(20, 300), DROP])).toMatchObject([
    { radius_mm: 20 },
  ]);
  const both: Step = { type: 'set', settings: { symmetry: 'both' } };
  expect(shapesOf([both, tool('post'), click(50, 300)])).toHaveLength(4);
  const free: Step = { type: 'set', settings: { snap_mm: 0 } };
  expect(shapesOf([free, tool('post'), click(1.5, 299)])).toMatchObject([{ center: [1.5, 299] }]);
});

it('erases, also on the other side, and changes nothing where nothing is', () => {
  const two: Step[] = [
    { type: 'set', settings: { symmetry: 'sides' } },
    tool('post'),
    click(50, 300),
  ];
  expect(shapesOf([...two, tool('erase'), click(50, 300)])).toEqual([]);
  const one: Step[] = [...two, { type: 'set', settings: { symmetry: 'none' } }, tool('erase')];
  expect(shapesOf([...one, click(50, 300)])).toHaveLength(1);
  const nothing = run(one);
  expect(run([drag(-200, 300), drag(-200, 400), DROP], nothing).drawing).toBe(nothing.drawing);
});

describe('a shape that is there', () => {
  const there = run([tool('post'), click(0, 300), click(100, 300), tool('move')]);

  it('is selected, moved, mirrored and deleted', () => {
    const selected = run([click(3, 302)], there);
    expect(selected.selected).toBe(0);
    expect(shapesOf([{ type: 'nudge', by: [1, -2] }], selected)[0]).toMatchObject({
      center: [1, 298],
    });
    expect(shapesOf([{ type: 'mirror', axis: 'sides' }], selected)).toMatchObject([
      { center: [-20, 300] },
      { center: [100, 300] },
    ]);
    expect(shapesOf([{ type: 'delete' }], selected)).toMatchObject([{ center: [100, 300] }]);
    expect(run([{ type: 'cancel' }], selected).selected).toBeUndefined();
    expect(run([click(50, 500)], selected).selected).toBeUndefined();
  });

  it('is dragged in steps of the grid', () => {
    const dragging = run([drag(101, 301), drag(113, 330)], there);
    expect(shift(dragging)).toEqual([10, 30]);
    expect(dragging.drawing).toBe(there.drawing);
    const dropped = run([DROP], dragging);
    expect(dropped.drawing.shapes[1]).toMatchObject({ center: [110, 330] });
    expect(dropped.selected).toBe(1);
    expect(run([drag(50, 500), drag(60, 500), DROP], there).drawing).toBe(there.drawing);
  });

  it('is not picked up by a drag that began beside it', () => {
    const beside = run([drag(50, 500)], there);
    expect(beside.trace).toEqual([]);
  });

  it('mirrors with all others when none is selected', () => {
    expect(shapesOf([{ type: 'mirror', axis: 'ends' }], there)).toMatchObject([
      { center: [0, 450] },
      { center: [100, 450] },
    ]);
  });
});

describe('start and goal', () => {
  it('are placed on the grid, moved, removed by a click on them, and mirrored with the drawing', () => {
    const placed = run([
      tool('start'),
      click(-101, 299),
      tool('goal'),
      drag(0, 300),
      drag(52, 348),
      DROP,
    ]);
    expect(placed.drawing.marks).toEqual({ start: [-100, 300], goal: [50, 350] });
    expect(placed.drawing.shapes).toEqual([]);
    expect(run([click(70, 300)], placed).drawing.marks?.goal).toEqual([70, 300]);
    expect(run([click(51, 349)], placed).drawing.marks).toEqual({ start: [-100, 300] });
    // The middle of the frame is at x = −10.
    expect(run([{ type: 'mirror', axis: 'sides' }], placed).drawing.marks).toEqual({
      start: [80, 300],
      goal: [-70, 350],
    });
    expect(run([tool('wall'), click(0, 300), { type: 'finish' }], placed).drawing.marks).toEqual(
      placed.drawing.marks,
    );
  });
});
