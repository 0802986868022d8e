// A button that sends a command. It is busy until the server answers.

import { createSignal, splitProps, type JSX } from 'solid-js';
import type { ClientMessage } from '../net/protocol.gen';
import type { Place } from './places';
import type { Session } from './slices';

interface CommandButtonProps extends Omit<
  JSX.ButtonHTMLAttributes<HTMLButtonElement>,
  'onClick' | 'command'
> {
  lab: Session;
  /** Where a refusal is shown. */
  at: Place;
  /** Undefined if there is nothing to send now. */
  command: (event: MouseEvent) => ClientMessage | undefined;
  /** After the command was carried out. */
  onDone?: () => void;
}

export function CommandButton(props: CommandButtonProps): JSX.Element {
  const [own, rest] = splitProps(props, ['lab', 'at', 'command', 'onDone', 'disabled']);
  const [open, setOpen] = createSignal(0);
  const click = async (event: MouseEvent): Promise<void> => {
    const message = own.command(event);
    if (!message) return;
    setOpen((count) => count + 1);
    const answer = await own.lab.send(own.at, message);
    setOpen((count) => count - 1);
    if (answer.kind === 'done') own.onDone?.();
  };
  return (
    <button
      type="button"
      {...rest}
      disabled={!own.lab.canOperate() || (own.disabled ?? false)}
      aria-busy={open() > 0}
      onClick={(event) => void click(event)}
    />
  );
}
