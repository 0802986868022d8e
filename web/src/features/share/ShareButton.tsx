// The page's experiment as a link to copy.

import { Show, createEffect, createResource, createSignal, type JSX } from 'solid-js';
import { Copy, Share2 } from 'lucide';
import { drawingForLink } from '../../lab/drawingLink';
import type { PageExperiment } from '../../lab/pageExperiment';
import { Icon } from '../../ui/Icon';
import { createPopover } from '../../ui/popover';
import './share.css';

export function ShareButton(props: {
  links: PageExperiment;
  /** The map of the experiment. */
  map: string | undefined;
  /** Below the link. */
  children: JSX.Element;
}): JSX.Element {
  let field!: HTMLInputElement;
  const [copied, setCopied] = createSignal('');
  const popover = createPopover('share');
  // Asked for when the link is.
  const [drawn] = createResource(() => (popover.open() ? props.map : undefined), drawingForLink);
  const address = (): string => {
    const { origin, pathname } = window.location;
    const { text } = drawn() ?? {};
    const drawing = text === undefined ? '' : `&drawing=${text}`;
    return `${origin}${pathname}${props.links.now() ?? ''}${drawing}`;
  };
  createEffect(() => {
    // The link has changed since it was copied, or the popover was opened again.
    props.links.now();
    popover.open();
    setCopied('');
  });
  const select = (): void => {
    field.focus();
    field.select();
    setCopied('Selected: copy it with the keyboard or the menu.');
  };
  const copy = (): void => {
    // The clipboard is missing on a page loaded by plain HTTP from another machine.
    const clipboard = navigator.clipboard as Clipboard | undefined;
    if (clipboard) clipboard.writeText(field.value).then(() => setCopied('Copied.'), select);
    else select();
  };
  return (
    <div {...popover.box} class="share">
      <button
        {...popover.button}
        aria-label="Share"
        title="Share: a link, a picture or a video"
        disabled={props.links.now() === undefined}
      >
        <Icon of={Share2} />
        <span class="share-word">Share</span>
      </button>
      <Show when={popover.open()}>
        <div
          id="share"
          class="popover of-top share-box"
          role="group"
          aria-label="Share this experiment"
        >
          <h3>Link to this experiment</h3>
          <div class="share-row">
            <input
              ref={field}
              type="text"
              readonly
              aria-label="Link to this experiment"
              value={address()}
              onFocus={() => field.select()}
            />
            <button type="button" class="primary" onClick={copy}>
              <Icon of={Copy} />
              Copy
            </button>
          </div>
          <p class="share-done" role="status">
            {copied()}
          </p>
          <p class="hint">
            It contains the map, seed, start, goal, controller, changed parameters and scripted
            disturbances, and begins at the start of this trial, with the last goal. It does not
            contain what you did by hand, such as drags and kicks. {drawn()?.remark}
          </p>
          {props.children}
        </div>
      </Show>
    </div>
  );
}
