// In place of results that do not exist yet: the question that they would answer.

import type { IconNode } from 'lucide';
import type { JSX } from 'solid-js';
import { Icon } from './Icon';
import './Empty.css';

export function Empty(props: {
  icon: IconNode;
  question: string;
  /** One sentence. */
  children: JSX.Element;
}): JSX.Element {
  return (
    <div class="empty">
      <Icon of={props.icon} />
      <h3>{props.question}</h3>
      <p>{props.children}</p>
    </div>
  );
}
