// What the server is asked for so that a layer can be drawn, whichever view draws it.

import { createMemo, type Accessor } from 'solid-js';
import { type Answer, createAnswer } from '../net/requests';
import type { Lab } from '../lab/lab';
import type { Palette } from '../ui/palette';
import type { Plane, PlaneQuery, WorkspaceMap, WorkspaceQuery } from '../net/protocol.gen';
import { createHeat, type Heat } from '../features/singularity/drawHeat';
import { createFieldPicture, type FieldPicture } from '../features/field/drawPlane';
import { createSeen, type Seen } from '../features/observed/drawObserved';
import { createFlowLayer, type FlowLayer } from '../features/flow/flowLayer';
import { createGoal } from '../lab/goal';
import { workspaceQuery } from '../features/singularity/heat';
import type { Layer } from '../lab/layers';
import { planeQuery } from '../features/field/plane';
import { createValueLayer, type ValueLayer } from '../features/values/valueLayer';
import type { Vec2 } from '../lab/geometry';

export interface Fields {
  readonly goal: Accessor<Vec2 | undefined>;
  /** Whether the layer of singularities is shown. */
  readonly showsHeat: Accessor<boolean>;
  readonly heatAnswer: Accessor<Answer<WorkspaceMap>>;
  readonly heat: Accessor<Heat | undefined>;
  readonly seen: Accessor<Seen | undefined>;
  readonly showsField: Accessor<boolean>;
  readonly fieldAnswer: Accessor<Answer<Plane>>;
  readonly field: Accessor<FieldPicture | undefined>;
  readonly showsFlow: Accessor<boolean>;
  readonly flow: FlowLayer;
  readonly showsValue: Accessor<boolean>;
  readonly value: ValueLayer;
}

export function createFields(
  lab: Lab,
  layers: Accessor<ReadonlySet<Layer>>,
  palette: Accessor<Palette>,
): Fields {
  const goal = createGoal(lab);

  const heatQuestion = createMemo<WorkspaceQuery | undefined>(() => {
    const scene = lab.scene();
    const parameters = lab.tuning();
    if (!scene || !parameters || !layers().has('singularity')) return undefined;
    return workspaceQuery(scene, parameters);
  });
  const showsHeat = (): boolean => heatQuestion() !== undefined;
  const heatAnswer = createAnswer<WorkspaceQuery, WorkspaceMap>('/api/kinematics/workspace', () =>
    lab.link().kind === 'live' ? heatQuestion() : undefined,
  );
  const heat = createMemo(() => {
    const map = heatAnswer().data;
    return map && createHeat(map, palette());
  });

  const seen = createMemo(() => {
    const message = layers().has('seen') ? lab.seen() : undefined;
    return message && createSeen(message, palette());
  });

  const showsField = createMemo(() => layers().has('field'));
  const fieldAnswer = createAnswer<PlaneQuery, Plane>('/api/magnetics/plane', () => {
    const parameters = lab.tuning();
    const asks = showsField() && lab.link().kind === 'live';
    return asks && parameters ? planeQuery(parameters) : undefined;
  });
  const field = createMemo(() => {
    const plane = fieldAnswer().data;
    return plane && showsField() ? createFieldPicture(plane, palette()) : undefined;
  });

  const showsFlow = createMemo(() => layers().has('flow'));
  const showsValue = createMemo(() => layers().has('value'));
  return {
    goal,
    showsHeat,
    heatAnswer,
    heat: () => (showsHeat() ? heat() : undefined),
    seen,
    showsField,
    fieldAnswer,
    field,
    showsFlow,
    flow: createFlowLayer(lab, goal, showsFlow),
    showsValue,
    value: createValueLayer(lab, goal, showsValue),
  };
}
