// The page of a shared experiment. A link from another site may not open a session, so the user presses a button here.

import { ownAddress } from '../../lab/ownSession';
import { theme } from '../../ui/theme';
import { part } from '../part';

theme();
const { search, hash } = window.location;
part('a', '.primary').href = ownAddress(search + hash);
