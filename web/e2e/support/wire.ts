// The types of the messages. This is the only import from the page's sources.

export type {
  CatalogMessage,
  ClientMessage,
  ComparisonMessage,
  ControllerName,
  EvaluationReport,
  Evaluations,
  EventMessage,
  Hello,
  Lumen,
  OverlayMessage,
  Parameters,
  Policies,
  SceneMessage,
  SeenMessage,
  ServerMessage,
  StateMessage,
  Trainings,
  TrainingSummary,
} from '../../src/net/protocol.gen';
