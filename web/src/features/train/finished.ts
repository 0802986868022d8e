// A finished training as it is shipped with the page.

import type {
  Examination,
  TrainingCells,
  TrainingFrame,
  TrainingQuery,
} from '../../net/protocol.gen';

export interface Finished {
  readonly query: TrainingQuery;
  readonly examined: Examination;
  readonly cells: TrainingCells;
  /** Its value maps. */
  readonly frames: readonly TrainingFrame[];
}
