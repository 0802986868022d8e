import type { Session } from './slices';

/** Attributes of a control that only the operator may use. */
export const operatorOnly = (lab: Session, title?: string) => ({
  get disabled() {
    return !lab.canOperate();
  },
  get title() {
    return lab.canOperate() ? title : 'Only the operator can do this';
  },
});
